"""The fixes of the island: pairs of settings, and of pictures, before and after."""

from landscape.fixes.best_fixes import BEST_FIXES
from landscape.fixes.fix import Fix
from landscape.fixes.report_fixes import REPORT_FIXES

FIXES: tuple[Fix, ...] = (*REPORT_FIXES, *BEST_FIXES)
