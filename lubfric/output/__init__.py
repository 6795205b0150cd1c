"""Tables, pictures, reports and the command line."""
