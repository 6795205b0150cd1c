"""Load sharing, Eq. (8) of the paper: film and contact carry one load."""
