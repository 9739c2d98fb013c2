"""`python -m framelens` is the command `framelens`."""

import sys

from framelens.cli import main

sys.exit(main())
