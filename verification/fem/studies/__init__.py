"""The studies that set `lubfric` beside finite elements and closed forms; `verification.catalogue` lists them."""
