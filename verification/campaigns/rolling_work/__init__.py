"""Counted work of the steps in time of moving roughness on random contacts, to which the estimates of lubfric are
fitted.

``python -m verification.campaigns.rolling_work COUNT [--workers N] [--seconds S]`` extends the table, one contact after
another, and prints the fit.
"""
