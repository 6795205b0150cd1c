"""Does every option reach the number? Quick checks whose expected values do not come from the code that is checked.

`film`, `contact`, `maps` and `time` are studies of a few seconds each. What they are worth is measured by breaking
`lubfric` (`verification.mutants`): one of them has to catch each of those mutants.
"""
