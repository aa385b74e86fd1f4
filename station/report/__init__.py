"""Self-contained report pages: sections of text, tables and charts, no foreign host."""
