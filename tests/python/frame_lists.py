"""Writes tests/frame-lists.tsv: frame lists as other tools read them, the oracle of tests/frames.rs.

Lists without overlaps, with `:` as the step, are read by openjd.model's IntRangeExpr; lists that
overlap, with `x` as the step, by fileseq's FrameSet. Both from PyPI; the table names the versions.
"""

import random
import sys
from importlib.metadata import version

from fileseq import FrameSet
from openjd.model import IntRangeExpr

random.seed(1905)


def part(mark):
    first = random.randint(-20, 60)
    if random.random() < 0.3:
        return str(first)
    last = first + random.randint(1, 40)
    step = f"{mark}{random.randint(1, 7)}" if random.random() < 0.5 else ""
    return f"{first}-{last}{step}"


def lists(mark):
    while True:
        yield ",".join(part(mark) for _ in range(random.randint(1, 4)))


def openjd(text):
    try:
        return sorted(IntRangeExpr.from_str(text))
    except Exception:  # overlaps, which it does not take
        return None


def rows(mark, read, count):
    found = 0
    for text in lists(mark):
        if (frames := read(text)) is not None:
            yield text, frames
            found += 1
            if found == count:
                return


out = open(sys.argv[1], "w", encoding="utf-8")
print(f"# written by tests/python/frame_lists.py with openjd-model {version('openjd-model')}"
      f" and fileseq {version('Fileseq')}", file=out)
print("# list\tframes", file=out)
for text, frames in [*rows(":", openjd, 60), *rows("x", lambda t: sorted(set(FrameSet(t))), 60)]:
    print(text, " ".join(map(str, frames)), sep="\t", file=out)
