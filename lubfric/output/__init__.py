"""Tables, pictures, reports and the command line."""

from .command_line import main
from .fields import write_moments
