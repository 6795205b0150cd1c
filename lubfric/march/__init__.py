"""The integration in time that all films with a memory share.

`bdf`: one step, its local error, and its repetition; `course`: from output to output, over the jumps of the histories.
Both work on a `Solver`, which is an implicit step of some equations, given as y' = rate (y - memory).
"""
