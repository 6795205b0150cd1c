"""Campaigns of many cases: hostile input, intervals, charts, stability, wiring, mutants, tables, benchmarks."""
