"""The functions of OpenGL 1.0 to 1.5, of GLU and GLUT, as PyOpenGL calls them: one line each.

    NAME  PARAMETER PARAMETER ... | PARAMETER ...

Braces in a name hold its variants: glVertex{2,3,4}{s,i,f,d} stands for twelve functions. A number
says how many of the plain parameters a variant has; letters are the type, as in the specification.
After "|" follow the other ways in which PyOpenGL accepts the arguments. Arguments at the end that a
call leaves out are outputs, which PyOpenGL then returns.

    PARAMETER   name, name:kind, name:kind*components=of@other[limits]

kind        "enum", "mask", "boolean", "int", "float", "clampf" (0 to 1), "angle" (degrees),
            "object" (the name of an OpenGL object, or a GLU object), "count", "vector", "matrix"
                    (16
            numbers, column by column), "array" (client memory or image data), "offset", "bits" (a
            pattern of bits), "text", "callback"; a parameter without a kind is a number of the
            variant's type, or a float where there is no type. "by" means that the argument "pname"
            decides: spec_enumerants.BY_PNAME has the kinds.
components  of a vector; N is the number in the function's name
of          the group of legal enumerants or bits (spec_enumerants.GROUPS), what an object is, or
            what a vector holds; with @other, the argument "other" decides: BY_OTHER
limits      [0..1], [>=0], [>0], [0..90|180] (180 is allowed, too)
"""

FUNCTIONS: dict[tuple[str, str], str] = {
    # (group, version in which the function appeared): functions
    ("begin_end", "1.0"): """
        glBegin     mode:enum=primitive
        glEnd
    """,
    ("vertex", "1.0"): """
        glVertex{2,3,4}{s,i,f,d}                x y z w
        glVertex{2,3,4}{s,i,f,d}v               v:vector*N=position
        glVertex                                x y z w | v:vector=position
        glColor{3,4}{b,s,i,f,d,ub,us,ui}        red green blue alpha
        glColor{3,4}{b,s,i,f,d,ub,us,ui}v       v:vector*N=color
        glColor                                 red green blue alpha | v:vector=color
        glNormal{3}{b,s,i,f,d}                  nx ny nz
        glNormal{3}{b,s,i,f,d}v                 v:vector*N=direction
        glNormal                                nx ny nz
        glTexCoord{1,2,3,4}{s,i,f,d}            s t r q
        glTexCoord{1,2,3,4}{s,i,f,d}v           v:vector*N=coordinates
        glTexCoord                              s t
        glIndex{s,i,f,d}                        c
        glIndex{s,i,f,d}v                       c:vector*1
        glEdgeFlag                              flag:boolean
        glEdgeFlagv                             flag:boolean*1
    """,
    ("vertex", "1.1"): """
        glIndex{ub}                             c
        glIndex{ub}v                            c:vector*1
        glArrayElement                          i:int[>=0]
    """,
    ("vertex", "1.3"): """
        glMultiTexCoord{1,2,3,4}{s,i,f,d}       target:enum=unit s t r q
        glMultiTexCoord{1,2,3,4}{s,i,f,d}v      target:enum=unit v:vector*N=coordinates
    """,
    ("vertex", "1.4"): """
        glFogCoord{f,d}                         coord
        glFogCoord{f,d}v                        coord:vector*1
        glSecondaryColor{3}{b,s,i,f,d,ub,us,ui} red green blue
        glSecondaryColor{3}{b,s,i,f,d,ub,us,ui}v  v:vector*N=color
    """,
    ("evaluator", "1.0"): """
        glMap1{f,d}             target:enum=map1 u1 u2 points:array
        glMap2{f,d}             target:enum=map2 u1 u2 v1 v2 points:array
        glMapGrid1{f,d}         un:count[>=1] u1 u2
        glMapGrid2{f,d}         un:count[>=1] u1 u2 vn:count[>=1] v1 v2
        glEvalCoord{1,2}{f,d}   u v
        glEvalCoord{1,2}{f,d}v  u:vector*N
        glEvalPoint1            i:int
        glEvalPoint2            i:int j:int
        glEvalMesh1             mode:enum=mesh1_mode i1:int i2:int
        glEvalMesh2             mode:enum=polygon_mode i1:int i2:int j1:int j2:int
    """,
    ("draw", "1.0"): """
        glClear                 mask:mask=clear
        glRect{s,i,f,d}         x1 y1 x2 y2
        glRect{s,i,f,d}v        v1:vector*2=position v2:vector*2=position
        glAccum                 op:enum=accum value
    """,
    ("draw", "1.1"): """
        glDrawArrays            mode:enum=primitive first:int[>=0] count:count
        glDrawElements          mode:enum=primitive count:count type:enum=index_type indices:array
        glDrawElements{ub,us,ui}  mode:enum=primitive indices:array
    """,
    ("draw", "1.2"): """
        glDrawRangeElements     mode:enum=primitive start:int[>=0] end:int[>=0] count:count
                type:enum=index_type indices:array
    """,
    ("draw", "1.4"): """
        glMultiDrawArrays       mode:enum=primitive first:array count:array drawcount:count
        glMultiDrawElements     mode:enum=primitive count:array type:enum=index_type indices:array
                drawcount:count
    """,
    ("pixel", "1.0"): """
        glRasterPos{2,3,4}{s,i,f,d}     x y z w
        glRasterPos{2,3,4}{s,i,f,d}v    v:vector*N=position
        glRasterPos                     x y z w | v:vector=position
        glBitmap                        width:count height:count xorig yorig xmove ymove
                bitmap:array
        glDrawPixels                    width:count height:count format:enum=draw_format
                type:enum=type@format pixels:array
        glDrawPixels{b,s,i,f,ub,us,ui}  format:enum=draw_format pixels:array
        glCopyPixels                    x:int y:int width:count height:count type:enum=copy_type
        glPixelZoom                     xfactor yfactor
        glPixelStore{f,i}               pname:enum=pixel_store param:by=pixel_store
        glPixelTransfer{f,i}            pname:enum=pixel_transfer param:by=pixel_transfer
        glPixelMap{f,ui,us}v            map:enum=pixel_map mapsize:count values:array
        glReadPixels                    x:int y:int width:count height:count format:enum=read_format
                type:enum=type@format array:array
        glReadPixels{b,s,i,f,d,ub,us,ui}  x:int y:int width:count height:count
                format:enum=read_format type:enum=type@format array:array
        glReadBuffer                    src:enum=read_buffer
    """,
    ("pixel", "1.4"): """
        glWindowPos{2,3}{s,i,f,d}       x y z
        glWindowPos{2,3}{s,i,f,d}v      v:vector*N=position
    """,
    ("matrix", "1.0"): """
        glMatrixMode            mode:enum=matrix_mode
        glLoadIdentity
        glLoadMatrix{f,d}       m:matrix*16
        glMultMatrix{f,d}       m:matrix*16
        glPushMatrix
        glPopMatrix
        glRotate{f,d}           angle:angle x y z
        glRotate                angle:angle x y z
        glTranslate{f,d}        x y z
        glTranslate             x y z
        glScale{f,d}            x y z
        glScale                 x y z
        glOrtho                 left right bottom top zNear zFar
        glFrustum               left right bottom top zNear:float[>0] zFar:float[>0]
    """,
    ("matrix", "1.3"): """
        glLoadTransposeMatrix{f,d}  m:matrix*16
        glMultTransposeMatrix{f,d}  m:matrix*16
    """,
    ("state", "1.0"): """
        glEnable                cap:enum=cap
        glDisable               cap:enum=cap
        glViewport              x:int y:int width:count height:count
        glDepthRange            n:clampf f:clampf
        glScissor               x:int y:int width:count height:count
        glClipPlane             plane:enum=clip_plane equation:vector*4=plane
        glShadeModel            mode:enum=shade_model
        glFrontFace             mode:enum=front_face
        glCullFace              mode:enum=face
        glPolygonMode           face:enum=face mode:enum=polygon_mode
        glPolygonStipple        mask:array
        glPointSize             size:float[>0]
        glLineWidth             width:float[>0]
        glLineStipple           factor:int[1..256] pattern:bits[0..65535]
        glLight{f,i}            light:enum=light pname:enum=light_parameter param:by=light_parameter
        glLight{f,i}v           light:enum=light pname:enum=light_parameter
                params:by=light_parameter
        glLight                 light:enum=light pname:enum=light_parameter
                params:by=light_parameter
        glLightModel{f,i}       pname:enum=light_model param:by=light_model
        glLightModel{f,i}v      pname:enum=light_model params:by=light_model
        glMaterial{f,i}         face:enum=face pname:enum=material param:by=material
        glMaterial{f,i}v        face:enum=face pname:enum=material params:by=material
        glMaterial              face:enum=face pname:enum=material params:by=material
        glColorMaterial         face:enum=face mode:enum=color_material
        glFog{f,i}              pname:enum=fog param:by=fog
        glFog{f,i}v             pname:enum=fog params:by=fog
        glAlphaFunc             func:enum=compare ref:clampf
        glStencilFunc           func:enum=compare ref:int[>=0] mask:bits
        glStencilOp             fail:enum=stencil_op zfail:enum=stencil_op zpass:enum=stencil_op
        glStencilMask           mask:bits
        glDepthFunc             func:enum=compare
        glDepthMask             flag:boolean
        glBlendFunc             sfactor:enum=source_factor dfactor:enum=destination_factor
        glLogicOp               opcode:enum=logic_op
        glColorMask             red:boolean green:boolean blue:boolean alpha:boolean
        glIndexMask             mask:bits
        glDrawBuffer            buf:enum=draw_buffer
        glClearColor            red:clampf green:clampf blue:clampf alpha:clampf
        glClearDepth            depth:clampf
        glClearStencil          s:int[>=0]
        glClearAccum            red:float[-1..1] green:float[-1..1] blue:float[-1..1]
                alpha:float[-1..1]
        glClearIndex            c
        glHint                  target:enum=hint_target mode:enum=hint_mode
        glPushAttrib            mask:mask=attrib
        glPopAttrib
    """,
    ("state", "1.1"): """
        glPolygonOffset         factor units
    """,
    ("state", "1.3"): """
        glSampleCoverage        value:clampf invert:boolean
    """,
    ("state", "1.4"): """
        glBlendColor            red:clampf green:clampf blue:clampf alpha:clampf
        glBlendEquation         mode:enum=blend_equation
        glBlendFuncSeparate     sfactorRGB:enum=source_factor dfactorRGB:enum=destination_factor
                sfactorAlpha:enum=source_factor dfactorAlpha:enum=destination_factor
        glPointParameter{f,i}   pname:enum=point_parameter param:by=point_parameter
        glPointParameter{f,i}v  pname:enum=point_parameter params:by=point_parameter
    """,
    ("texture", "1.0"): """
        glTexParameter{f,i}     target:enum=texture_target pname:enum=tex_parameter
                param:by=tex_parameter
        glTexParameter{f,i}v    target:enum=texture_target pname:enum=tex_parameter
                params:by=tex_parameter
        glTexParameter          target:enum=texture_target pname:enum=tex_parameter
                params:by=tex_parameter
        glTexEnv{f,i}           target:enum=env_target pname:enum=tex_env@target param:by=tex_env
        glTexEnv{f,i}v          target:enum=env_target pname:enum=tex_env@target params:by=tex_env
        glTexGen{i,f,d}         coord:enum=coord pname:enum=tex_gen param:by=tex_gen
        glTexGen{i,f,d}v        coord:enum=coord pname:enum=tex_gen params:by=tex_gen
        glTexImage1D            target:enum=image_target_1d level:int[>=0]
                internalformat:enum=internal_format width:count border:enum=border
                format:enum=tex_format@internalformat type:enum=type@format pixels:array
        glTexImage2D            target:enum=image_target_2d level:int[>=0]
                internalformat:enum=internal_format width:count height:count border:enum=border
                format:enum=tex_format@internalformat type:enum=type@format pixels:array
        glTexImage1D{b,s,i,f,ub,us,ui}  target:enum=image_target_1d level:int[>=0]
                internalformat:enum=internal_format border:enum=border
                format:enum=tex_format@internalformat pixels:array
        glTexImage2D{b,s,i,f,ub,us,ui}  target:enum=image_target_2d level:int[>=0]
                internalformat:enum=internal_format border:enum=border
                format:enum=tex_format@internalformat pixels:array
    """,
    ("texture", "1.1"): """
        glBindTexture           target:enum=texture_target texture:object=texture
        glGenTextures           n:count textures:array=texture
        glDeleteTextures        n:count textures:array=texture | textures:array=texture
        glPrioritizeTextures    n:count textures:array=texture priorities:array
        glTexSubImage1D         target:enum=texture_1d level:int[>=0] xoffset:int width:count
                format:enum=subimage_format type:enum=type@format pixels:array
        glTexSubImage2D         target:enum=subimage_target_2d level:int[>=0] xoffset:int
                yoffset:int width:count height:count format:enum=subimage_format
                type:enum=type@format pixels:array
        glTexSubImage1D{b,s,i,f,ub,us,ui}  target:enum=texture_1d level:int[>=0] xoffset:int
                format:enum=subimage_format pixels:array
        glTexSubImage2D{b,s,i,f,ub,us,ui}  target:enum=subimage_target_2d level:int[>=0] xoffset:int
                yoffset:int format:enum=subimage_format pixels:array
        glCopyTexImage1D        target:enum=texture_1d level:int[>=0]
                internalformat:enum=copy_format x:int y:int width:count border:enum=border
        glCopyTexImage2D        target:enum=subimage_target_2d level:int[>=0]
                internalformat:enum=copy_format x:int y:int width:count height:count
                border:enum=border
        glCopyTexSubImage1D     target:enum=texture_1d level:int[>=0] xoffset:int x:int y:int
                width:count
        glCopyTexSubImage2D     target:enum=subimage_target_2d level:int[>=0] xoffset:int
                yoffset:int x:int y:int width:count height:count
    """,
    ("texture", "1.2"): """
        glTexImage3D            target:enum=image_target_3d level:int[>=0]
                internalformat:enum=internal_format width:count height:count depth:count
                border:enum=border format:enum=color_format type:enum=type@format pixels:array
        glTexSubImage3D         target:enum=texture_3d level:int[>=0] xoffset:int yoffset:int
                zoffset:int width:count height:count depth:count format:enum=color_format
                type:enum=type@format pixels:array
        glTexImage3D{b,s,i,f,ub,us,ui}  target:enum=image_target_3d level:int[>=0]
                internalformat:enum=internal_format border:enum=border format:enum=color_format
                pixels:array
        glTexSubImage3D{b,s,i,f,ub,us,ui}  target:enum=texture_3d level:int[>=0] xoffset:int
                yoffset:int zoffset:int format:enum=color_format pixels:array
        glCopyTexSubImage3D     target:enum=texture_3d level:int[>=0] xoffset:int yoffset:int
                zoffset:int x:int y:int width:count height:count
    """,
    ("texture", "1.3"): """
        glActiveTexture             texture:enum=unit
        glCompressedTexImage1D      target:enum=image_target_1d level:int[>=0]
                internalformat:enum=compressed_format width:count border:enum=border data:array
        glCompressedTexImage2D      target:enum=image_target_2d level:int[>=0]
                internalformat:enum=compressed_format width:count height:count border:enum=border
                data:array
        glCompressedTexImage3D      target:enum=image_target_3d level:int[>=0]
                internalformat:enum=compressed_format width:count height:count depth:count
                border:enum=border data:array
        glCompressedTexSubImage1D   target:enum=texture_1d level:int[>=0] xoffset:int width:count
                format:enum=compressed_format data:array
        glCompressedTexSubImage2D   target:enum=subimage_target_2d level:int[>=0] xoffset:int
                yoffset:int width:count height:count format:enum=compressed_format data:array
        glCompressedTexSubImage3D   target:enum=texture_3d level:int[>=0] xoffset:int yoffset:int
                zoffset:int width:count height:count depth:count format:enum=compressed_format
                data:array
    """,
    ("list", "1.0"): """
        glNewList               list:object=list mode:enum=list_mode
        glEndList
        glCallList              list:object=list
        glCallLists             n:count type:enum=lists_type lists:array=list | lists:array=list
        glListBase              base:int[>=0]
        glGenLists              range:count
        glDeleteLists           list:object=list range:count
    """,
    ("array", "1.1"): """
        glEnableClientState     array:enum=client_array
        glDisableClientState    array:enum=client_array
        glVertexPointer         size:enum=size_2_4 type:enum=vertex_type stride:int[>=0]
                pointer:array
        glColorPointer          size:enum=size_3_4 type:enum=color_type stride:int[>=0]
                pointer:array
        glNormalPointer         type:enum=normal_type stride:int[>=0] pointer:array
        glTexCoordPointer       size:enum=size_1_4 type:enum=vertex_type stride:int[>=0]
                pointer:array
        glIndexPointer          type:enum=index_array_type stride:int[>=0] pointer:array
        glEdgeFlagPointer       stride:int[>=0] pointer:array
        glVertexPointer{b,s,i,f,d}          pointer:array
        glColorPointer{b,s,i,f,d,ub,us,ui}  pointer:array
        glNormalPointer{b,s,i,f,d}          pointer:array
        glTexCoordPointer{b,s,i,f,d}        pointer:array
        glIndexPointer{b,s,i,f,d,ub}        pointer:array
        glEdgeFlagPointer{b}                pointer:array
        glInterleavedArrays     format:enum=interleaved_format stride:int[>=0] pointer:array
        glPushClientAttrib      mask:mask=client_attrib
        glPopClientAttrib
    """,
    ("array", "1.3"): """
        glClientActiveTexture   texture:enum=unit
    """,
    ("array", "1.4"): """
        glFogCoordPointer       type:enum=fog_coord_type stride:int[>=0] pointer:array
        glSecondaryColorPointer size:enum=size_3 type:enum=color_type stride:int[>=0] pointer:array
    """,
    ("buffer", "1.5"): """
        glGenBuffers            n:count buffers:array=buffer
        glDeleteBuffers         n:count buffers:array=buffer
        glBindBuffer            target:enum=buffer_target buffer:object=buffer
        glBufferData            target:enum=buffer_target size:count data:array
                usage:enum=buffer_usage | target:enum=buffer_target data:array
                usage:enum=buffer_usage
        glBufferSubData         target:enum=buffer_target offset:int[>=0] size:count data:array |
                target:enum=buffer_target offset:int[>=0] data:array
        glMapBuffer             target:enum=buffer_target access:enum=buffer_access
        glUnmapBuffer           target:enum=buffer_target
    """,
    ("query", "1.5"): """
        glGenQueries            n:count ids:array=query
        glDeleteQueries         n:count ids:array=query | ids:array=query
        glBeginQuery            target:enum=query_target id:object=query
        glEndQuery              target:enum=query_target
    """,
    ("select", "1.0"): """
        glRenderMode            newMode:enum=render_mode
        glSelectBuffer          size:count buffer:array
        glFeedbackBuffer        size:count type:enum=feedback_type buffer:array
        glInitNames
        glLoadName              name:int[>=0]
        glPushName              name:int[>=0]
        glPopName
        glPassThrough           token
    """,
    ("sync", "1.0"): """
        glFlush
        glFinish
    """,
    ("get", "1.0"): """
        glGetError
        glGetString             name:enum=string_name
        glGetBoolean{,v}        pname:enum=get data:array
        glGetInteger{,v}        pname:enum=get data:array
        glGetFloat{,v}          pname:enum=get data:array
        glGetDouble{,v}         pname:enum=get data:array
        glIsEnabled             cap:enum=is_enabled
        glIsList                list:object=list
        glGetClipPlane          plane:enum=clip_plane equation:array
        glGetLight{f,i}v        light:enum=light pname:enum=light_parameter params:array
        glGetMaterial{f,i}v     face:enum=one_face pname:enum=get_material params:array
        glGetMap{d,f,i}v        target:enum=map_target query:enum=get_map v:array
        glGetPixelMap{f,ui,us}v map:enum=pixel_map values:array
        glGetPolygonStipple     mask:array
        glGetPolygonStipple{ub} mask:array
        glGetTexEnv{f,i}v       target:enum=env_target pname:enum=tex_env@target params:array
        glGetTexGen{d,f,i}v     coord:enum=coord pname:enum=tex_gen params:array
        glGetTexParameter{f,i}v target:enum=texture_target pname:enum=get_tex_parameter params:array
        glGetTexLevelParameter{f,i}v  target:enum=level_target level:int[>=0]
                pname:enum=tex_level_parameter params:array
        glGetTexImage           target:enum=get_image_target level:int[>=0]
                format:enum=get_image_format type:enum=type@format array:array
        glGetTexImage{b,s,i,f,d,ub,us,ui}  target:enum=get_image_target level:int[>=0]
                format:enum=get_image_format type:enum=type@format array:array
    """,
    ("get", "1.1"): """
        glGetPointerv           pname:enum=pointer_name params:array
        glIsTexture             texture:object=texture
        glAreTexturesResident   n:count textures:array=texture residences:array | n:count
                textures:array=texture | textures:array=texture
    """,
    ("get", "1.3"): """
        glGetCompressedTexImage target:enum=get_image_target level:int[>=0] img:array
    """,
    ("get", "1.5"): """
        glIsBuffer              buffer:object=buffer
        glIsQuery               id:object=query
        glGetBufferParameteriv  target:enum=buffer_target pname:enum=buffer_parameter params:array
        glGetBufferPointerv     target:enum=buffer_target pname:enum=buffer_pointer params:array
        glGetBufferSubData      target:enum=buffer_target offset:int[>=0] size:count data:array
        glGetQueryiv            target:enum=query_target pname:enum=query_parameter params:array
        glGetQueryObject{i,ui}v id:object=query pname:enum=query_object_parameter params:array
    """,
    # Functions of later versions that fixed-function programs use.
    ("framebuffer", "3.0"): """
        glGenFramebuffers           n:count framebuffers:array=framebuffer
        glDeleteFramebuffers        n:count framebuffers:array=framebuffer
        glBindFramebuffer           target:enum=framebuffer_target framebuffer:object=framebuffer
        glCheckFramebufferStatus    target:enum=framebuffer_target
        glFramebufferTexture1D      target:enum=framebuffer_target attachment:enum=attachment
                textarget:enum=texture_1d texture:object=texture level:int[>=0]
        glFramebufferTexture2D      target:enum=framebuffer_target attachment:enum=attachment
                textarget:enum=subimage_target_2d texture:object=texture level:int[>=0]
        glFramebufferTexture3D      target:enum=framebuffer_target attachment:enum=attachment
                textarget:enum=texture_3d texture:object=texture level:int[>=0] zoffset:int[>=0]
        glFramebufferRenderbuffer   target:enum=framebuffer_target attachment:enum=attachment
                renderbuffertarget:enum=renderbuffer_target renderbuffer:object=renderbuffer
        glGenRenderbuffers          n:count renderbuffers:array=renderbuffer
        glDeleteRenderbuffers       n:count renderbuffers:array=renderbuffer
        glBindRenderbuffer          target:enum=renderbuffer_target renderbuffer:object=renderbuffer
        glRenderbufferStorage       target:enum=renderbuffer_target
                internalformat:enum=renderbuffer_format width:count height:count
        glRenderbufferStorageMultisample  target:enum=renderbuffer_target samples:count
                internalformat:enum=renderbuffer_format width:count height:count
        glBlitFramebuffer           srcX0:int srcY0:int srcX1:int srcY1:int dstX0:int dstY0:int
                dstX1:int dstY1:int mask:mask=blit filter:enum=blit_filter
        glGenerateMipmap            target:enum=texture_target
    """,
    ("get", "3.0"): """
        glIsFramebuffer             framebuffer:object=framebuffer
        glIsRenderbuffer            renderbuffer:object=renderbuffer
        glGetRenderbufferParameteriv  target:enum=renderbuffer_target
                pname:enum=renderbuffer_parameter params:array
        glGetFramebufferAttachmentParameteriv  target:enum=framebuffer_target
                attachment:enum=attachment pname:enum=attachment_parameter params:array
    """,
    ("state", "2.0"): """
        glBlendEquationSeparate modeRGB:enum=blend_equation modeAlpha:enum=blend_equation
        glStencilFuncSeparate   face:enum=face func:enum=compare ref:int[>=0] mask:bits
        glStencilMaskSeparate   face:enum=face mask:bits
        glStencilOpSeparate     face:enum=face sfail:enum=stencil_op dpfail:enum=stencil_op
                dppass:enum=stencil_op
    """,
    ("matrix", "GLU"): """
        gluPerspective      fovy:angle[0..180] aspect:float[>0] zNear:float[>0] zFar:float[>0]
        gluLookAt           eyeX eyeY eyeZ centerX centerY centerZ upX upY upZ
        gluOrtho2D          left right bottom top
        gluPickMatrix       x y delX:float[>0] delY:float[>0] viewport:vector*4=viewport
    """,
    ("get", "GLU"): """
        gluProject          objX objY objZ model:matrix*16 proj:matrix*16 view:vector*4=viewport
        gluUnProject        winX winY winZ model:matrix*16 proj:matrix*16 view:vector*4=viewport
        gluUnProject4       winX winY winZ clipW model:matrix*16 proj:matrix*16
                view:vector*4=viewport near far
        gluErrorString      error:enum=error
        gluGetString        name:enum=glu_string_name
        gluCheckExtension   extName:text extString:text
        gluScaleImage       format:enum=color_format wIn:count hIn:count typeIn:enum=type@format
                dataIn:array wOut:count hOut:count typeOut:enum=type@format dataOut:array
    """,
    ("texture", "GLU"): """
        gluBuild1DMipmaps   target:enum=texture_1d internalFormat:enum=internal_format width:count
                format:enum=color_format type:enum=type@format data:array
        gluBuild2DMipmaps   target:enum=subimage_target_2d internalFormat:enum=internal_format
                width:count height:count format:enum=color_format type:enum=type@format data:array
        gluBuild3DMipmaps   target:enum=texture_3d internalFormat:enum=internal_format width:count
                height:count depth:count format:enum=color_format type:enum=type@format data:array
    """,
    ("quadric", "GLU"): """
        gluNewQuadric
        gluDeleteQuadric        quad:object=quadric
        gluQuadricDrawStyle     quad:object=quadric draw:enum=quadric_style
        gluQuadricNormals       quad:object=quadric normal:enum=quadric_normals
        gluQuadricOrientation   quad:object=quadric orientation:enum=quadric_orientation
        gluQuadricTexture       quad:object=quadric texture:boolean
        gluQuadricCallback      quad:object=quadric which:enum=quadric_callback function:callback
    """,
    ("draw", "GLU"): """
        gluSphere               quad:object=quadric radius:float[>=0] slices:count[>=2]
                stacks:count[>=1]
        gluCylinder             quad:object=quadric base:float[>=0] top:float[>=0] height:float[>=0]
                slices:count[>=2] stacks:count[>=1]
        gluDisk                 quad:object=quadric inner:float[>=0] outer:float[>0]
                slices:count[>=2] loops:count[>=1]
        gluPartialDisk          quad:object=quadric inner:float[>=0] outer:float[>0]
                slices:count[>=1] loops:count[>=1] start:angle sweep:angle
    """,
    ("tessellator", "GLU"): """
        gluNewTess
        gluDeleteTess           tess:object=tessellator
        gluTessBeginPolygon     tess:object=tessellator data:array
        gluTessBeginContour     tess:object=tessellator
        gluTessVertex           tess:object=tessellator location:vector*3=position data:array
        gluTessEndContour       tess:object=tessellator
        gluTessEndPolygon       tess:object=tessellator
        gluTessNormal           tess:object=tessellator valueX valueY valueZ
        gluTessProperty         tess:object=tessellator which:enum=tess_property data:float
        gluTessCallback         tess:object=tessellator which:enum=tess_callback function:callback
        gluBeginPolygon         tess:object=tessellator
        gluNextContour          tess:object=tessellator type:enum=tess_contour
        gluEndPolygon           tess:object=tessellator
    """,
    ("nurbs", "GLU"): """
        gluNewNurbsRenderer
        gluDeleteNurbsRenderer  nurb:object=nurbs
        gluNurbsProperty        nurb:object=nurbs property:enum=nurbs_property value:float
        gluNurbsCallback        nurb:object=nurbs which:enum=nurbs_callback function:callback
        gluLoadSamplingMatrices nurb:object=nurbs model:matrix*16 perspective:matrix*16
                view:vector*4=viewport
        gluBeginCurve           nurb:object=nurbs
        gluNurbsCurve           nurb:object=nurbs knots:array control:array type:enum=curve_type
        gluEndCurve             nurb:object=nurbs
        gluBeginSurface         nurb:object=nurbs
        gluNurbsSurface         nurb:object=nurbs sKnots:array tKnots:array control:array
                type:enum=surface_type
        gluEndSurface           nurb:object=nurbs
        gluBeginTrim            nurb:object=nurbs
        gluPwlCurve             nurb:object=nurbs data:array type:enum=trim_type
        gluEndTrim              nurb:object=nurbs
    """,
    ("draw", "GLUT"): """
        glutSolidSphere         radius slices:count[>=1] stacks:count[>=1]
        glutWireSphere          radius slices:count[>=1] stacks:count[>=1]
        glutSolidCube           size
        glutWireCube            size
        glutSolidCone           base height slices:count[>=1] stacks:count[>=1]
        glutWireCone            base height slices:count[>=1] stacks:count[>=1]
        glutSolidCylinder       radius height slices:count[>=1] stacks:count[>=1]
        glutWireCylinder        radius height slices:count[>=1] stacks:count[>=1]
        glutSolidTorus          innerRadius outerRadius sides:count[>=1] rings:count[>=1]
        glutWireTorus           innerRadius outerRadius sides:count[>=1] rings:count[>=1]
        glutSolidTeapot         size
        glutWireTeapot          size
        glutSolidTetrahedron
        glutWireTetrahedron
        glutSolidOctahedron
        glutWireOctahedron
        glutSolidDodecahedron
        glutWireDodecahedron
        glutSolidIcosahedron
        glutWireIcosahedron
        glutSolidRhombicDodecahedron
        glutWireRhombicDodecahedron
        glutSolidSierpinskiSponge   num_levels:count offset:vector*3=position scale
        glutWireSierpinskiSponge    num_levels:count offset:vector*3=position scale
        glutBitmapCharacter     font:object=font character:int[>=0]
        glutBitmapString        font:object=font string:text
        glutStrokeCharacter     font:object=font character:int[>=0]
        glutStrokeString        font:object=font string:text
    """,
    ("get", "GLUT"): """
        glutBitmapWidth         font:object=font character:int[>=0]
        glutBitmapLength        font:object=font string:text
        glutBitmapHeight        font:object=font
        glutStrokeWidth         font:object=font character:int[>=0]
        glutStrokeLength        font:object=font string:text
        glutStrokeHeight        font:object=font
    """,
}

DRAWS = (
    *("glBegin", "glRect", "glEvalMesh1", "glEvalMesh2", "glDrawArrays", "glDrawElements"),
    *("glDrawRangeElements", "glMultiDrawArrays", "glMultiDrawElements", "glClear", "glAccum"),
    *("glBitmap", "glDrawPixels", "glCopyPixels", "glBlitFramebuffer", "gluTessEndPolygon"),
    *("gluEndPolygon", "gluEndCurve", "gluEndSurface"),
)
"""What writes into the framebuffer, beside the group "draw"; glBegin for its block up to glEnd."""

QUERIES = ("glReadPixels", "glCheckFramebufferStatus")
"""What changes nothing, beside the group "get"."""

AT_ONCE = (
    *("glNewList", "glEndList", "glGenLists", "glDeleteLists", "glFeedbackBuffer"),
    *("glSelectBuffer", "glRenderMode", "glReadPixels", "glPixelStore", "glGenTextures"),
    *("glDeleteTextures", "glGenQueries", "glDeleteQueries", "glFlush", "glFinish", "gluNewTess"),
    *("gluDeleteTess", "gluTessProperty", "gluTessCallback", "gluTessNormal"),
    *("gluNewNurbsRenderer", "gluDeleteNurbsRenderer", "gluNurbsProperty", "gluNurbsCallback"),
    "gluLoadSamplingMatrices",
)
"""Never compiled into a display list (section 5.4 of the specification), beside whole groups."""

LEFT_OUT = {
    "glInitGl": "asks PyOpenGL whether a version is present; OpenGL has no such function",
    "glInitImaging": "asks PyOpenGL, too",
    "ColorTable": "belongs to the optional imaging subset, which today's OpenGLs lack",
    "ColorSubTable": "imaging subset",
    "Convolution": "imaging subset",
    "Separable": "imaging subset",
    "Histogram": "imaging subset",
    "Minmax": "imaging subset",
}
"""Parts of the names of functions that are not in the table, and why."""
