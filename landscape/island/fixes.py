"""The fixes of the island: pairs of settings, and of pictures, before and after.

safeguard.py is what other scenes have instead: pairs whose captions speak of one scene alone.
"""

from landscape.island.best_fixes import BEST_FIXES
from landscape.island.fix import Fix
from landscape.island.report_fixes import REPORT_FIXES

FIXES: tuple[Fix, ...] = (*REPORT_FIXES, *BEST_FIXES)
