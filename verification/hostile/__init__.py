"""Bad input from a seeded generator: scenes, files, calls and command lines that must each be refused in words.

`scenes`, `files`, `calls` and `commands` make the cases. `judge` runs one and says how it ended. None may end in
another exception than lubfric's own, be answered with a number, take longer than 8 s, or take more than 2 GB.
"""
