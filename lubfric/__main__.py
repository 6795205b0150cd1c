"""``python -m lubfric`` is the ``lubfric`` command. Little is imported here, so that an interrupt while the rest is
imported ends in one line too."""

import sys

# What the system says where there is no memory for a shared library.
NO_MEMORY = ("failed to map segment", "cannot allocate memory", "Cannot allocate memory")


# Address space of the modules and of their first linear algebra with one thread [bytes], measured: 311 MB. With less,
# OpenBLAS may try without end to get its buffers.
MODULES = 320 * 10**6


def main() -> int:
    """Run the ``lubfric`` command and return its exit code."""
    try:
        if 0 <= (limit := _address_space()) < MODULES:
            raise MemoryError(f"{MODULES / 1e6:.0f} MB of address space, and the limit is {limit / 1e6:.0f} MB")
        from .output import main as command

        return command()
    except KeyboardInterrupt:  # outside of the command's own handling: while it is imported
        print("lubfric: interrupted", file=sys.stderr)
        return 130
    except (MemoryError, ImportError) as error:  # the same
        if isinstance(error, ImportError) and not any(words in str(error) for words in NO_MEMORY):
            raise
        print(f"lubfric: not enough memory to load its modules: it needs {error}; allow more", file=sys.stderr)
        return 1


def _address_space() -> int:
    """Return the limit of the address space of this process [bytes], -1 where there is none."""
    try:
        import resource
    except ImportError:  # not on Windows
        return -1
    return resource.getrlimit(resource.RLIMIT_AS)[0]


if __name__ == "__main__":
    raise SystemExit(main())
