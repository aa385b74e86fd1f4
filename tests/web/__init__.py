"""The service over HTTP and WebSocket, on fake devices and a real store."""
