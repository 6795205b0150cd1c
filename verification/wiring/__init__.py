"""Does every option reach the number? Quick checks whose expected values do not come from the code that is checked.

`film`, `contact`, `maps`, `time`: studies of a few seconds each. What they are worth is measured by breaking `lubfric`
(`verification.wiring_mutants`): each of those mutants has to be caught by one of them.
"""
