"""The service: REST, live feed and the operator's page."""
