"""How often the diagnosis names the right cause, on machines that the emulator makes up."""
