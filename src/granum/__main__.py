"""``python -m granum``: the command line where the ``granum`` script is not on the path."""

from granum.cli import main

if __name__ == "__main__":
    main()
