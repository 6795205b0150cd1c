"""What only the comparison with the paper needs (docs/paper.md)."""

from .differential import solve_differential_deflection
from .imposed_film import alternating
from .single_loop import single_loop
