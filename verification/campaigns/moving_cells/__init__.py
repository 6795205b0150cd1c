"""The error of f by the cells along x where roughness moves: the same strips on cells a half and a quarter as long.

``python -m verification.campaigns.moving_cells [--halvings N] [--seeds N] [--budget S]`` extends the table.
"""
