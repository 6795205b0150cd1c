"""Quick checks that every option reaches the result. Their expected values do not come from the checked code.

`film`, `contact`, `maps` and `time` are studies of a few seconds each. Errors that are put into `lubfric` on purpose
(`verification.campaigns.mutants`) measure their power: at least one check has to detect each of them.
"""
