"""The table of all causes: each has an ID, a sentence that says what is wrong, and the mend.

A sentence is filled in with the numbers that were found; the ID of a mend is that of its cause with
".mend" behind it. docs/why.md lists the IDs for those who read the JSON.
"""

from collections.abc import Mapping

from framelens.base.texts import Texts, translator

CAUSES: Texts = {
    # The window.
    "no-swap": "The picture is drawn into the back buffer and never shown: nothing swaps the "
    "buffers.",
    "no-swap.mend": "add {swap} after the last call that draws in {function}()",
    "no-flush": "The window has a single buffer, and nothing sends the drawing on to it: the "
    "display callback ends without glFlush().",
    "no-flush.mend": "add glFlush() at the end of {function}(), or ask for GLUT_DOUBLE and call "
    "glutSwapBuffers()",
    "front-buffer": "The frame is drawn into the front buffer; then the swap replaces it by the "
    "back buffer, into which nothing was drawn.",
    "front-buffer.mend": "leave this call out, or write glDrawBuffer(GL_BACK)",
    "swapped-twice": "Line {line} swaps the buffers once more without drawing in between: the "
    "window shows the other buffer, which holds an old picture or nothing.",
    "swapped-twice.mend": "call {swap} once for each picture: leave out the one in line {line}",
    "no-redisplay": "Nothing asks for a redraw: callbacks change values, but the window keeps "
    "its old picture.",
    "no-redisplay.mend": "call glutPostRedisplay() where the values change, in the timer, idle or "
    "key callback",
    "before-context": "{call} is called before there is a context: it has no effect.",
    "before-context.mend": "move this line after {opening}",
    # Calls.
    "no-end-list": "glEndList is missing: display list {list} takes in all calls that follow, and "
    "none of them is executed.",
    "no-end-list.mend": "call glEndList() after the last call of the list, in line {line}",
    "no-end": "A glBegin, in line {begin}, is still open: the glEnd after this line is missing. "
    "OpenGL refuses all other calls until it comes, and the error is reported elsewhere.",
    "no-end.mend": "add glEnd() after the last glVertex, in {function}()",
    "inside-begin": "{call} is not allowed between glBegin, in line {begin}, and glEnd: OpenGL "
    "refuses it. PyOpenGL reports it only at the glEnd.",
    "inside-begin.mend": "make this call before the glBegin in line {begin}",
    "outside-begin": "{call} is called outside of glBegin and glEnd: it draws nothing.",
    "outside-begin.mend": "write glBegin(...) before the vertices, and glEnd() after them",
    "refused": "OpenGL refuses {call}: {error}.",
    "refused.mend": "give it what it accepts, or make it where it is allowed",
    # The frame.
    "late-clear": "This glClear wipes what the frame has drawn before it: {draws} draws.",
    "late-clear.mend": "call glClear before the first draw of the frame",
    "no-clear": "No glClear clears the colours: what earlier frames drew stays in the picture.",
    "no-clear.mend": "call glClear(GL_COLOR_BUFFER_BIT) at the beginning of each frame",
    "no-depth-clear": "The depth test is on, and no glClear clears the depths: those of earlier "
    "frames hide what is drawn now.",
    "no-depth-clear.mend": "call glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT) at the "
    "beginning of each frame",
    "clear-masked": "A mask is on while the glClear in line {clear} clears: it leaves the buffer "
    "as it was.",
    "clear-masked.mend": "call {mask} before the glClear in line {clear}",
    "leak": "{state} is {value} when this frame begins to draw, and was {former} in the first "
    "one: an earlier frame has left it so.",
    "leak.mend": "set {state} back to {former} after its use, or at the beginning of each frame",
    "accumulated": "The matrix is multiplied once more in each frame, {frames} times so far: "
    "nothing loads it before.",
    "accumulated.mend": "call glLoadIdentity() before this call, in each frame",
    "accum-zero": "{call} takes nothing of the picture into the accumulation buffer: its factor is "
    "0, as a division of whole numbers (//) gives.",
    "accum-zero.mend": "write 1 / {n}, with one stroke",
    "accum-no-return": "Pictures are added up in the accumulation buffer, and never returned to "
    "the window.",
    "accum-no-return.mend": "call glAccum(GL_RETURN, 1.0) after the last of them",
    # Tests.
    "alpha-test": "The alpha test ({function}, {reference}) is on and lets nothing of these draws "
    "pass.",
    "alpha-test.mend": "call glDisable(GL_ALPHA_TEST) before they are drawn",
    "stencil-test": "The stencil test ({function}, {reference}) is on and lets nothing of these "
    "draws pass.",
    "stencil-test.mend": "call glDisable(GL_STENCIL_TEST) before they are drawn",
    "scissor-test": "The scissor test is on, and these draws lie outside its box {box}.",
    "scissor-test.mend": "call glDisable(GL_SCISSOR_TEST) before they are drawn",
    "clip-plane": "Clip plane {plane} cuts these draws off altogether.",
    "clip-plane.mend": "call glDisable(GL_CLIP_PLANE{plane}) before they are drawn",
    "color-mask": "The colour mask lets no component through.",
    "color-mask.mend": "call glColorMask(True, True, True, True) before the draw",
    "line-stipple": "The line stipple leaves nothing of these lines.",
    "line-stipple.mend": "give glLineStipple a pattern such as 0x00FF, or disable GL_LINE_STIPPLE",
    "logic-op": "GL_COLOR_LOGIC_OP is on, and {operation} leaves the picture as it was.",
    "logic-op.mend": "call glDisable(GL_COLOR_LOGIC_OP)",
    "stipple": "The polygon stipple leaves nothing of these draws.",
    "stipple.mend": "call glDisable(GL_POLYGON_STIPPLE)",
    "cull-front": "glCullFace({value}) removes the front faces, which are those that one sees.",
    "cull-front.mend": "write glCullFace(GL_BACK)",
    "front-face": "With glFrontFace({value}) faces that are wound counter-clockwise count as back "
    "faces, and are culled.",
    "front-face.mend": "write glFrontFace(GL_CCW)",
    "mirrored": "A scale by a negative number mirrors the shape: its faces are wound the other way "
    "round, count as back faces and are culled.",
    "mirrored.mend": "call glFrontFace(GL_CW) before the mirrored draw and glFrontFace(GL_CCW) "
    "after it",
    "inside": "The camera is inside the shape, and GL_CULL_FACE, enabled in line {cull}, removes "
    "the faces seen from inside.",
    "inside.mend": "move the shape farther from the camera, or call glDisable(GL_CULL_FACE)",
    "culled": "GL_CULL_FACE removes these faces, drawn in line {drawn}: seen from here they are "
    "wound clockwise, and the front face is {winding}.",
    "culled.mend": "give the vertices in the opposite order, or call glDisable(GL_CULL_FACE)",
    "inside-out": "GL_CULL_FACE removes the outer faces of this shape, drawn in line {drawn}: they "
    "are wound clockwise, and the front face is {winding}.",
    "inside-out.mend": "call glFrontFace(GL_CW) for this shape, or glDisable(GL_CULL_FACE)",
    "winding": "Face {face} is wound against its neighbours ({faces} of them are): it counts as a "
    "back face, and GL_CULL_FACE removes it.",
    "winding.mend": "give the vertices of this face in the opposite order",
    "depth-func": "glDepthFunc({value}) lets nothing pass: the depth buffer was cleared to "
    "{clear}.",
    "depth-func.mend": "write glDepthFunc(GL_LESS)",
    "clear-depth": "The depth buffer is cleared to {value}: nothing is nearer.",
    "clear-depth.mend": "write glClearDepth(1.0)",
    "depth-range": "glDepthRange, now {value}, turns the depths round.",
    "depth-range.mend": "write glDepthRange(0.0, 1.0)",
    "depth-test": "The depth test ({function}) lets nothing of these draws pass.",
    "depth-test.mend": "call glDisable(GL_DEPTH_TEST) before them, or clear the depth buffer to 1 "
    "before them",
    "near-zero": "The near plane is at {near}: all depths become the same, and the depth test "
    "cannot tell what is in front.",
    "near-zero.mend": "write a near plane above 0, such as 0.1",
    "no-depth-test": "GL_DEPTH_TEST is not enabled: what is drawn later lies on top, even if it is "
    "farther away.",
    "no-depth-test.mend": "call glEnable(GL_DEPTH_TEST) once, in the setup",
    "translucent-first": "A translucent shape (alpha {alpha}) is drawn before what lies behind it "
    "(line {later}), and writes its depth: the depth test then rejects what is behind.",
    "translucent-first.mend": "draw translucent shapes last, from far to near, with "
    "glDepthMask(GL_FALSE)",
    "no-blend": "What is drawn has an alpha of {alpha}, but GL_BLEND is not enabled: alpha has no "
    "effect.",
    "no-blend.mend": "call glEnable(GL_BLEND)",
    "alpha-zero": "Blending is on and the colour's alpha is {value}: nothing of it is seen.",
    "alpha-zero.mend": "write an alpha above 0",
    "blend": "Blending by {source} and {destination} leaves the picture as it was.",
    "blend.mend": "call glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA), or glDisable(GL_BLEND)",
    "same-color": "The shape is drawn ({n} pixels), in the colour {value} that is behind it "
    "already.",
    "same-color.mend": "set another colour before it, or another glClearColor",
    "fog": "The shape lies {nearest} to {farthest} away, where the fog hides all: {state} is "
    "{value}.",
    "fog.mend": "let the fog begin and end farther away, or make it thinner",
    "overdrawn": "This draw covers all that was drawn before it: {draws} draws.",
    "overdrawn.mend": "draw it first, before the others",
    "viewport": "The viewport is {box}, and the window has {width} x {height} pixels.",
    "viewport.mend": "call glViewport(0, 0, {width}, {height})",
    "render-mode": "The render mode is {value}: in it nothing is drawn.",
    "render-mode.mend": "call glRenderMode(GL_RENDER) before drawing",
    "framebuffer": "The last draws go into framebuffer {value}, not into the window's.",
    "framebuffer.mend": "call glBindFramebuffer(GL_FRAMEBUFFER, 0) before drawing for the window",
    "wireframe": "glPolygonMode, set in {function}(), is still {value} for what is drawn in line "
    "{later}.",
    "wireframe.mend": "call glPolygonMode(GL_FRONT_AND_BACK, GL_FILL) after its use",
    # Vertices and matrices.
    "nan": "{n} vertices are not numbers (nan or inf): the primitives with them are not drawn.",
    "nan.mend": "find the division by 0 or the root of a negative number that they come from",
    "nan-matrix": "{matrix} holds values that are not numbers.",
    "nan-matrix.mend": "find the division by 0 that they come from",
    "too-few-vertices": "glBegin({mode}) gets {n} vertices and needs {needed} for one primitive.",
    "too-few-vertices.mend": "give {needed} vertices, or choose another mode",
    "no-vertices": "glBegin({mode}) gets no vertices: what is to make them makes none.",
    "no-vertices.mend": "look at the loop between glBegin and glEnd: it never runs",
    "left-over": "glBegin({mode}) gets {n} vertices, and takes them {size} by {size}: {left} of "
    "them are not drawn.",
    "left-over.mend": "give all vertices, or another mode, such as GL_QUADS or GL_TRIANGLE_FAN",
    "map-not-enabled": "{map} is not enabled: glEvalCoord, in line {line}, makes no vertices.",
    "map-not-enabled.mend": "call glEnable({map}) after this line",
    "tiny": "The shape is smaller than a pixel: {extent} pixels.",
    "tiny.mend": "scale it less, or bring it nearer",
    "zero-scale": "{call} flattens the shape: it has no area.",
    "zero-scale.mend": "write 1 instead of 0",
    "no-area": "All {n} vertices lie on one point or line: the shape has no area.",
    "no-area.mend": "check the coordinates of the vertices",
    "crossed-quad": "The corners of the quad are not in the order of its outline: it crosses "
    "itself ({n} of them).",
    "crossed-quad.mend": "give the corners in order, round the quad",
    "concave": "{mode} must be convex, and this one is not ({n} of them): OpenGL fills what lies "
    "between its points.",
    "concave.mend": "draw it as triangles, as a GL_TRIANGLE_FAN round a point in its middle",
    "aspect-zero": "{call} has an aspect of 0, as a division of whole numbers (//) gives: it sets "
    "no projection at all.",
    "aspect-zero.mend": "write width / height, with one stroke",
    "no-effect": "{call} has no effect: with these numbers there is no projection.",
    "no-effect.mend": "give an angle between 0 and 180, and a near plane unlike the far one",
    "glu-nothing": "{call} draws nothing: GLU needs a positive size, at least 2 slices and 1 "
    "stack.",
    "glu-nothing.mend": "give it a positive size, and 16 slices and stacks for instance",
    "fovy-radians": "gluPerspective wants degrees: {fovy} is an angle of view of {fovy} degrees.",
    "fovy-radians.mend": "write {degrees}",
    "perspective": "{call} makes no view that one can look through.",
    "perspective.mend": "give an angle between 0 and 180, and planes with 0 < near < far",
    "look-at-up": "{call}: the up vector is parallel to the line of sight, so no direction is up.",
    "look-at-up.mend": "give another up vector, such as 0, 0, -1",
    "look-at-nowhere": "{call}: the eye is where it looks at.",
    "look-at-nowhere.mend": "give a point to look at that is not the eye",
    "frustum-wide": "The frustum is {half} to a side at a near plane of {near}: an angle of view "
    "of {angle} degrees, in which everything is tiny. glFrustum wants lengths, not degrees.",
    "frustum-wide.mend": "give sides of about the near plane's distance, or call gluPerspective",
    "transposed": "{call} gets its matrix row by row, and OpenGL reads columns: the translation "
    "lands where the perspective stands.",
    "transposed.mend": "give the transposed matrix (matrix.T), or call glLoadTransposeMatrix",
    "rotate-radians": "glRotate wants degrees: {angle} looks like radians.",
    "rotate-radians.mend": "write {degrees}",
    "projection-wiped": "The projection of {call} is wiped by the glLoadIdentity in line {wiped}: "
    "glMatrixMode(GL_MODELVIEW) is missing after it.",
    "projection-wiped.mend": "call glMatrixMode(GL_MODELVIEW) after it",
    "projection-on-modelview": "{call} multiplies the modelview matrix, and the glLoadIdentity in "
    "line {wiped} wipes it.",
    "projection-on-modelview.mend": "call glMatrixMode(GL_PROJECTION) before it, and "
    "glMatrixMode(GL_MODELVIEW) after it",
    "camera-wiped": "This glLoadIdentity wipes the camera of {call}, in line {line}.",
    "camera-wiped.mend": "call glLoadIdentity() before gluLookAt, not after it",
    "pick-matrix-left": "{call} is still in force in line {line}: a few pixels fill the window.",
    "pick-matrix-left.mend": "call glPushMatrix() before it, and glPopMatrix() after picking, both "
    "in the mode GL_PROJECTION",
    "matrix-zero": "{call} gets a matrix without an inverse: it leaves nothing of the shape.",
    "matrix-zero.mend": "fill its whole diagonal, the last 1 too",
    "camera-in-projection": "{call} stands in the projection matrix: fog and lighting are computed "
    "as if the camera stood at the origin.",
    "camera-in-projection.mend": "call glMatrixMode(GL_MODELVIEW) before it",
    "matrix-mode": "The matrix mode is {mode} when {call} in line {line} is to move an object.",
    "matrix-mode.mend": "call glMatrixMode(GL_MODELVIEW) before line {line}",
    "piled-up": "{function}() multiplies the matrix {times} times and never takes it back: its "
    "scale piles up from one object to the next.",
    "piled-up.mend": "call glPushMatrix() at its beginning and glPopMatrix() at its end",
    "not-undone": "{function}() changes the matrix and does not take it back: what is drawn after "
    "it is moved out of the view.",
    "not-undone.mend": "call glPushMatrix() at its beginning and glPopMatrix() at its end",
    "pop-too-many": "There is one glPopMatrix more than glPushMatrix.",
    "pop-too-many.mend": "leave this glPopMatrix out, or add its glPushMatrix",
    "push-without-pop": "A glPopMatrix is missing: {n} glPushMatrix are never taken back.",
    "push-without-pop.mend": "call glPopMatrix() when the object is drawn",
    "behind": "{behind} of {n} vertices lie behind the eye, which looks along -z.",
    "behind.mend": "move the shape away from the eye: to a negative z, in {call}",
    "around-the-eye": "The shape of line {line} is drawn where the camera stands, and fills the "
    "picture from inside.",
    "around-the-eye.mend": "move it away by glTranslatef before it is drawn, after glLoadIdentity "
    "and between glPushMatrix and glPopMatrix",
    "beyond-near": "The shape is {nearest} to {farthest} away, in front of the near plane at "
    "{near}, which cuts it off.",
    "beyond-near.mend": "write a near plane below {nearest}, in {call}",
    "beyond-far": "The shape is {nearest} to {farthest} away, beyond the far plane at {far}.",
    "beyond-far.mend": "write a far plane above {farthest}, in {call}",
    "no-projection": "There is no projection: all that is seen lies between -1 and 1, and the "
    "vertices do not.",
    "no-projection.mend": "call gluOrtho2D or gluPerspective, in the mode GL_PROJECTION",
    "beside": "All vertices lie outside the view: {sides}.",
    "beside.mend": "move the shape or the camera",
    # Lighting.
    "light-off": "{light} is not enabled: it gives no light.",
    "light-off.mend": "call glEnable({light})",
    "lighting-off": "{light} is enabled, but GL_LIGHTING is not: it lights nothing.",
    "lighting-off.mend": "call glEnable(GL_LIGHTING)",
    "light-far-side": "{light} stands on the far side of what is seen: only ambient light is left.",
    "light-far-side.mend": "put the light on the side of the camera, by its GL_POSITION",
    "spot": "{light} is a spot light, and its cone of {cutoff} degrees does not meet what is seen.",
    "spot.mend": "turn GL_SPOT_DIRECTION towards it, or write a larger GL_SPOT_CUTOFF",
    "attenuation": "{light} fades with the distance, and too fast: {kind} is {value}.",
    "attenuation.mend": "write a smaller {kind}, or bring the light nearer",
    "light-black": "The diffuse colour of {light} is black.",
    "light-black.mend": "give it a colour: glLightfv({light}, GL_DIFFUSE, (1, 1, 1, 1))",
    "no-normals": "The vertices have no normals ({n} of them): all are lit as if they faced along "
    "{value}.",
    "no-normals.mend": "call glNormal3f before the vertices of each face",
    "normals-length": "The normals have a length of {length} when light is computed, because of "
    "a scale: it is too bright or too dark.",
    "normals-length.mend": "call glEnable(GL_NORMALIZE)",
    "normals-away": "The normals point away from the side that is seen: it is lit from behind.",
    "normals-away.mend": "turn the normals round",
    "no-color-material": "With GL_LIGHTING the colour of glColor, line {color}, has no effect: "
    "GL_COLOR_MATERIAL is not enabled.",
    "no-color-material.mend": "call glEnable(GL_COLOR_MATERIAL)",
    "color-material-which": "glColor goes into the material's {parameter} of {face}, not into its "
    "diffuse colour.",
    "color-material-which.mend": "call glColorMaterial(GL_FRONT_AND_BACK, GL_AMBIENT_AND_DIFFUSE)",
    "material-face": "The material is set for GL_BACK, and the front faces are seen.",
    "material-face.mend": "write GL_FRONT or GL_FRONT_AND_BACK",
    "emission-left": "The emission {value} is still set for what is drawn in line {later}, which "
    "glows.",
    "emission-left.mend": "set GL_EMISSION back to black after its use",
    "material-black": "The diffuse colour of the material is black: it reflects no light.",
    "material-black.mend": "give it a colour: glMaterialfv(GL_FRONT, GL_DIFFUSE, ...)",
    "light-before-camera": "{call} comes before the gluLookAt in line {camera}: the light moves "
    "with the camera.",
    "light-before-camera.mend": "call it after the gluLookAt in line {camera}, in each frame",
    # Textures.
    "unpack-alignment": "A row of the image has {row} bytes ({width} pixels), and OpenGL expects "
    "{padded}: GL_UNPACK_ALIGNMENT is {value}.",
    "unpack-alignment.mend": "call glPixelStorei(GL_UNPACK_ALIGNMENT, 1) before glTexImage2D",
    "unpack-row-length": "GL_UNPACK_ROW_LENGTH is still {length} in line {line}, and the image's "
    "rows have {width} pixels.",
    "unpack-row-length.mend": "call glPixelStorei(GL_UNPACK_ROW_LENGTH, 0) before line {line}",
    "image-format": "The image has {channels} numbers for each pixel, and OpenGL is told {said}.",
    "image-format.mend": "write {format} as the format",
    "image-too-small": "The image has {given} bytes, and OpenGL reads {needed}.",
    "image-too-small.mend": "give width, height and format as the image has them",
    "upside-down": "{call} gives the top row first, and OpenGL takes the first row for the lowest: "
    "the picture is upside down.",
    "upside-down.mend": "turn the rows round: with flipped=True in pygame, with "
    "FLIP_TOP_BOTTOM in PIL",
    "texture-incomplete": "Texture {texture} is not complete, so it is not used: {state} is "
    "{value}, which reads smaller levels, and level {level} ({width} x {height}) is missing.",
    "texture-incomplete.mend": "set GL_TEXTURE_MIN_FILTER to GL_LINEAR, or make all levels, by "
    "gluBuild2DMipmaps",
    "texture-not-bound": "Texture {texture} is bound, which has no image; texture {other} has one "
    "(line {image}).",
    "texture-not-bound.mend": "call glBindTexture(GL_TEXTURE_2D, ...) with the texture's name "
    "before the draw",
    "texture-off": "Texture {texture} is bound and coordinates are given, but GL_TEXTURE_2D is not "
    "enabled.",
    "texture-off.mend": "call glEnable(GL_TEXTURE_2D)",
    "coords-in-pixels": "The texture coordinates go over {s} x {t}, in pixels: the image of "
    "{width} x {height} is repeated so often.",
    "coords-in-pixels.mend": "give coordinates from 0 to 1: divide by {width} and {height}",
    "texture-left": "GL_TEXTURE_2D is still enabled for what is drawn in line {later} without "
    "texture coordinates: all of it has the colour of one texel.",
    "texture-left.mend": "call glDisable(GL_TEXTURE_2D) before it",
    "no-coords": "The vertices have no texture coordinates: all of the shape has the colour of one "
    "texel.",
    "no-coords.mend": "call glTexCoord2f before each vertex",
    "texture-times-black": "The texture is multiplied by the current colour {value}, which is "
    "black or nearly so.",
    "texture-times-black.mend": "call glColor3f(1, 1, 1) before the textured draw",
    # Arrays.
    "array-not-enabled": "{call} says where the array is, but {array} is not enabled.",
    "array-not-enabled.mend": "call glEnableClientState({array})",
    "offset-int": "{call}: the offset {offset} is an int. PyOpenGL makes an array of it; OpenGL "
    "does not read from the buffer there.",
    "offset-int.mend": "write ctypes.c_void_p({offset})",
    "dtype": "glBufferData gives {dtype} to a buffer that is read as {type}: other numbers come "
    "out.",
    "dtype.mend": "make the array with dtype=np.{wanted}",
    "pointer-size": "{call} takes {size} numbers for each vertex, and a row of the array has "
    "{columns}.",
    "pointer-size.mend": "write {columns} as its size",
    "array-left": "GL_COLOR_ARRAY is still enabled in line {line}: the colours come from this "
    "array, and glColor has no effect.",
    "array-left.mend": "call glDisableClientState(GL_COLOR_ARRAY) after the draw that it is for",
    "stride": "{call}: the stride is {stride}, and a row of the data has {row} bytes.",
    "stride.mend": "write {right}",
    "index-type": "The indices are {dtype}, and are read as {type}.",
    "index-type.mend": "make the array of indices with dtype=np.{wanted}",
    "count": "{call} draws {n} vertices of {all}.",
    "count.mend": "give the number of vertices, {all}",
    "list-unknown": "Display list {list} is empty or was never made; list {other} holds calls, and "
    "is never called.",
    "list-unknown.mend": "call the list that was made",
    # Colours and letters.
    "list-base": "glCallLists counts from list {base}, GL_LIST_BASE, and there are no such lists: "
    "the first one is {first}.",
    "list-base.mend": "call glListBase({first}) before it",
    "list-not-called": "Display list {list} is compiled, and never called: what it holds is not "
    "drawn.",
    "list-not-called.mend": "call glCallList({list}) in each frame, after glClear",
    "color-range": "{call}: this colour goes from 0 to 1, and all above is 1.",
    "color-range.mend": "write glColor3ub, or divide by 255",
    "color-range-bytes": "{call}: this colour goes from 0 to 255, so this is nearly black.",
    "color-range-bytes.mend": "write glColor3f",
    "raster-invalid": "{call} lies outside the view, at pixel {x}, {y}: the raster position is not "
    "valid, and no letter is drawn.",
    "raster-invalid.mend": "begin inside the view",
    "color-after-raster": "{call} comes after glRasterPos, in line {raster}, which has taken the "
    "colour for the letters already.",
    "color-after-raster.mend": "set the colour before glRasterPos",
    "text-lit": "GL_LIGHTING is on at glRasterPos, in line {raster}: the letters have the colour "
    "that a lit point has there.",
    "text-lit.mend": "call glDisable(GL_LIGHTING) before glRasterPos",
    "text-textured": "GL_TEXTURE_2D is on while letters are drawn: they are multiplied by a texel.",
    "text-textured.mend": "call glDisable(GL_TEXTURE_2D) before glRasterPos",
}

WORDS: Texts = {
    "visible": "Nothing is wrong with this frame, as far as can be told: what it draws is visible.",
    "visible-at": "Nothing is wrong at pixel {x},{y}, as far as can be told: it shows what line "
    "{line} draws.",
    "background-at": "Nothing is drawn at pixel {x},{y}, and nothing seems to keep anything from "
    "it.",
    "not-found": "The cause was not found.",
    "nothing-drawn": "The frame draws nothing: no call of it makes a primitive.",
    "one-color": "The picture shows one colour, or only the background.",
    "wrong": "Something is wrong with this frame.",
    "wrong-at": "Something is wrong at pixel {x},{y}.",
    "pixels": "With this mend {n} pixels change.",
    "unseen": "{n} pixels are not shown.",
    "mend": "Mend: {mend}.",
    "ruled-out": "Tried and ruled out: {causes}.",
    "walk": "Draws that leave no trace, through the pipeline:",
}

FAMILIES: dict[str, str] = {
    **dict.fromkeys(
        ("cull-front", "front-face", "culled", "inside-out", "mirrored", "inside", "winding"),
        "culling",
    ),
    **dict.fromkeys(("depth-func", "clear-depth", "depth-range", "depth-test"), "depth"),
    **dict.fromkeys(
        ("behind", "beyond-near", "beyond-far", "beside", "no-projection", "not-undone"), "outside"
    ),
    **dict.fromkeys(("light-off", "light-black", "light-far-side", "no-color-material"), "light"),
    **dict.fromkeys(("spot", "attenuation"), "light"),
}
"""Causes that exclude each other: of each family only the likeliest is named."""

IDS = tuple(key for key in CAUSES if not key.endswith(".mend"))


def text(language: str, cause: str, values: Mapping[str, object]) -> str:
    """Return what is wrong, in a sentence."""
    return _filled(language, CAUSES[cause], cause, values)


def mend(language: str, cause: str, values: Mapping[str, object]) -> str:
    """Return what would mend it."""
    return _filled(language, CAUSES[f"{cause}.mend"], f"{cause}.mend", values)


def word(language: str, key: str, **values: object) -> str:
    """Return another text of the report."""
    return _filled(language, WORDS[key], key, values)


def _filled(language: str, english: str, key: str, values: Mapping[str, object]) -> str:
    template = translator(language, "why")(english, key)
    return template.format_map({name: shown(value) for name, value in values.items()})


def shown(value: object) -> object:
    """Return a value as it stands in a sentence."""
    if isinstance(value, bool):
        return "GL_TRUE" if value else "GL_FALSE"
    if isinstance(value, float):
        return f"{value:.4g}"
    if isinstance(value, (list, tuple)):
        return ", ".join(str(shown(each)) for each in value)
    return value
