"""Tables, pictures, reports and the command line."""

from .command_line import main, parser
from .commands import read_record, wrapped
from .contact_pictures import DrawnContact, drawn_contact, plot_contact
from .curve_tables import details_of_points
from .describe import describe_scene, described_scene, estimate_scene
from .fields import fields_bytes, grid_bytes, write_moments
from .fit_report import fit_status
from .inputs import inputs
from .page import FRAME, framed
from .picture_options import PictureOptions
from .pictures import plot_history, plot_stribeck, plot_surface, plot_traction
from .progress import ProgressLine
from .regime import regime_in_words, regimes_in_words
from .rolling_part import negative_in_words
from .run_curve import lines_of_point
from .status import orders_of_magnitude
from .swept_values import in_percent, parse_ratios, parse_speeds
from .time_left import TimeLeft
