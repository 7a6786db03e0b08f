#!/usr/bin/python3
"""The words that a newcomer reads before the first case of their own runs: first_case.py SOURCE

README.md up to its section on cases, then the tutorial of a vessel up to the end of its run, code included:
at most 1200.
"""
import os
import sys

WAY = (("README.md", "\n## A case of your own"), ("doc/tutorial/own_vessel.md", "\n## 5."))
MOST = 1200


def main():
    counted = []
    for name, end in WAY:
        with open(os.path.join(sys.argv[1], name), encoding="utf-8") as file:
            counted.append(len(file.read().split(end)[0].split()))
        print(f"{counted[-1]} words of {name}")
    print(f"{sum(counted)} words to the first own case, at most {MOST}")
    return 1 if sum(counted) > MOST else 0


if __name__ == "__main__":
    sys.exit(main())
