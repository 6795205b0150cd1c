"""Estimated times of runs against the processor time that they take, on random scenes of usual ranges.

``python -m verification.campaigns.estimates COUNT [--workers N] [--seconds S] [--kinds KIND ...] [--docs docs]``
extends the table, one run after another; ``... 0`` shows what is in it, ``... 0 --again`` estimates its runs again.
"""
