"""Times of `lubfric` and of others, each a script: ``python -m verification.campaigns.benchmarks.NAME``."""
