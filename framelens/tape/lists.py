"""Display lists compiled again: under the same number, from the same calls, with edits.

OpenGL cannot change a list. But the seam has noted the calls that each was compiled from, so all of
them can be made once more between glNewList and glEndList, and every glCallList executes the new
ones from then on.
"""

from collections.abc import Collection
from dataclasses import replace

from framelens.gl.seam import Call, Listing, gl, lists_now, unnoted
from framelens.tape.edits import Edits, ListKey
from framelens.tape.steps import issue


def recompile(keys: Collection[ListKey], edits: Edits) -> int:
    """Compile again, as ``edits`` say, the current context's lists with these keys.

    Return how many there were.
    """
    found = [item for item in lists_now().items() if ListKey.of(item[1]) in keys]
    for number, listing in found:
        compile_again(number, listing, edits)
    return len(found)


def compile_again(number: int, listing: Listing, edits: Edits) -> None:
    """Compile one list again: the program's own calls, changed by ``edits`` alone."""
    edits.begin_list(listing)
    calls = [_changed(call, edits) for call in listing.calls()]
    edits.end_list()
    with unnoted():
        # Pointers and the like are not compiled, but set when they are called.
        gl.glPushClientAttrib(gl.GL_CLIENT_ALL_ATTRIB_BITS)
        gl.glNewList(number, gl.GL_COMPILE)
        try:
            for call in calls:
                issue(call)
        finally:
            gl.glEndList()
            gl.glPopClientAttrib()
    listing.put(calls)


def _changed(call: Call, edits: Edits) -> Call:
    """Return a call as the edits have it."""
    own = call.args if call.given is None else call.given
    args = edits.change(call.name, own, call.shared_by, call.pass_, call.site)
    if args is None:
        return replace(call, args=own, given=None, kept=None, skipped=True)
    given = None if args is own else own
    return replace(call, args=args, given=given, kept=None, skipped=False)
