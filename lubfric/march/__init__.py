"""The march in time that every film with a memory shares.

`bdf`: one step, its local error, and its retry; `course`: from output to output, over the jumps of the histories. What
is marched is a `Solver`: an implicit step of some equations, given as y' = rate (y - memory).
"""
