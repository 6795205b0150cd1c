"""Tables, pictures, reports and the command line."""

from .command_line import main
