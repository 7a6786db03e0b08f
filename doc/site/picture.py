#!/usr/bin/python3
"""A picture of a run for the gallery, small enough to be kept: picture.py FROM TO

    doc/site/picture.py out/torus/flow.png doc/gallery/torus.png
"""
import sys

from PIL import Image

WIDTH = 720  # pixels
COLOURS = 96


def main():
    picture = Image.open(sys.argv[1]).convert("RGB")
    size = (WIDTH, round(picture.height * WIDTH / picture.width))
    small = picture.resize(size, Image.LANCZOS).quantize(COLOURS, dither=Image.Dither.NONE)
    small.save(sys.argv[2], optimize=True)


if __name__ == "__main__":
    main()
