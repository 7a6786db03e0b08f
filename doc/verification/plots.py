#!/usr/bin/python3
"""Draws the pictures of these pages from their tables: plots.py [PAGE...]

PAGE.png shows the table of PAGE.md and holds a mark of it, by which tests/reference/pages.py tells
whether the table has changed since. Without a PAGE all are drawn, but for those of fields: disc.png
is made by tests/verification/disc/run.py, paper.png of the figures of examples/paper/run.
"""
import os
import sys

from plot_parts import HERE, SOURCE, pages, plt, style, text_of
import plots_of_flow
import plots_of_solids


def main():
    style.apply()
    known = {draw.__name__: draw for draw in plots_of_flow.PICTURES + plots_of_solids.PICTURES}
    for page in sys.argv[1:] or known:
        if page not in known:
            sys.exit(f'no picture is called "{page}"; there are {", ".join(known)}')
        figure, path = known[page](), os.path.join(HERE, page + ".png")
        mark = pages.mark(pages.tables(text_of(page))[0])
        figure.savefig(path, dpi=style.DPI, facecolor="white", bbox_inches="tight", pad_inches=0.08,
                       metadata={"Description": mark, "Software": None})
        plt.close(figure)
        print(os.path.relpath(path, SOURCE), os.path.getsize(path) // 1000, "kB")


if __name__ == "__main__":
    main()
