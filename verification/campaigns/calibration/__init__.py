"""Load sharing against the deterministic model on random contacts: the table behind the calibrated error model.

``python -m verification.campaigns.calibration`` extends the table (`table`), one case after another (`case`, `solve`).
"""
