"""Work-precision charts: what every numerical choice costs and buys."""
