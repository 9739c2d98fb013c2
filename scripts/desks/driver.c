/* OpenGL as another driver has it, over OSMesa: fewer texture units, extensions that are not there, an
   older version, lines one pixel wide. The environment says what (see drivers.py):

     DRIVER_UNITS    how many texture units there are
     DRIVER_VERSION  what GL_VERSION says, as "2.1 Other"
     DRIVER_HIDDEN   names of extensions that GL_EXTENSIONS lacks, "all" for all
     DRIVER_THIN     1: no line is wider than one pixel
     DRIVER_LOG      a file that gets a line for each call that this driver refuses

   A call that is refused does nothing but raise GL_INVALID_OPERATION, as with a real driver. A program
   that asks before it calls is never refused. The library takes the place of libOSMesa.so.8 and is
   linked to the real one, renamed, in which all other functions are found. */

#define _GNU_SOURCE
#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    EXTENSIONS = 0x1F03, VERSION = 0x1F02, UNITS = 0x84E2, UNIT0 = 0x84C0,
    LINES = 0x846E, SMOOTH_LINES = 0x0B22, INVALID_OPERATION = 0x0502,
    TEXTURE_1D = 0x0DE0, TEXTURE_2D = 0x0DE1, TEXTURE_3D = 0x806F, CUBE_MAP = 0x8513,
    GEN_S = 0x0C60, GEN_Q = 0x0C63, DOT3_RGB = 0x86AE, DOT3_RGBA = 0x86AF, SOURCE_FIRST = 0x8580, SOURCE_LAST = 0x858A,
};

typedef unsigned Enum;
typedef void (*Function)(void);

static int unit;     /* the active one, from 0 */
static Enum pending; /* the error that glGetError returns next */

static void *real(const char *name) {
    static void *library;
    if (!library && !(library = dlopen("libOSMesa.so.R", RTLD_NOW))) {
        fprintf(stderr, "%s\n", dlerror());
        abort();
    }
    return dlsym(library, name);
}

/* Declares `next`, the real function of the same name and type. */
#define NEXT(name) \
    static __typeof__(name) *next; \
    if (!next) next = (__typeof__(name) *)real(#name)

static const char *asked(const char *name) {
    const char *value = getenv(name);
    return value && *value ? value : NULL;
}

static int units(void) {
    const char *value = asked("DRIVER_UNITS");
    return value ? atoi(value) : 8;
}

static int thin(void) { return asked("DRIVER_THIN") != NULL; }

static int hidden(const char *name, size_t length) {
    const char *list = asked("DRIVER_HIDDEN");
    while (list && *list) {
        size_t next = strcspn(list, " ,");
        if ((next == length && !strncmp(list, name, length)) || (next == 3 && !strncmp(list, "all", 3)))
            return 1;
        list += next + strspn(list + next, " ,");
    }
    return 0;
}

/* Whether an extension is hidden that OpenGL has had in itself since a version that this is not. */
static int missing(const char *extension, double since) {
    const char *version = asked("DRIVER_VERSION");
    return version && atof(version) < since && hidden(extension, strlen(extension));
}

static int refused(int condition, const char *call, Enum value) {
    const char *log = asked("DRIVER_LOG");
    FILE *out = condition && log ? fopen(log, "a") : NULL;
    if (out) {
        fprintf(out, "%s 0x%X on unit %d\n", call, value, unit);
        fclose(out);
    }
    if (condition) pending = INVALID_OPERATION;
    return condition;
}

static int beyond(void) { return unit >= units(); }

static int of_texture(Enum cap) {
    return cap == TEXTURE_1D || cap == TEXTURE_2D || cap == TEXTURE_3D || cap == CUBE_MAP
        || (cap >= GEN_S && cap <= GEN_Q);
}

static int source_of_another(Enum name, int value) {
    return name >= SOURCE_FIRST && name <= SOURCE_LAST && value >= UNIT0 && value < UNIT0 + 32;
}

void glActiveTexture(Enum which) {
    NEXT(glActiveTexture);
    unit = (int)(which - UNIT0);
    next(which);
}

void glEnable(Enum cap) {
    NEXT(glEnable);
    if (!refused(of_texture(cap) && beyond(), "glEnable", cap)) next(cap);
}

void glTexEnvi(Enum target, Enum name, int value) {
    NEXT(glTexEnvi);
    int dot3 = value == DOT3_RGB || value == DOT3_RGBA;
    int known = !(dot3 && missing("GL_ARB_texture_env_dot3", 1.3))
        && !(source_of_another(name, value) && missing("GL_ARB_texture_env_crossbar", 1.4));
    if (!refused(beyond() || !known, "glTexEnvi", name)) next(target, name, value);
}

void glTexEnvf(Enum target, Enum name, float value) {
    NEXT(glTexEnvf);
    if (!refused(beyond(), "glTexEnvf", name)) next(target, name, value);
}

void glGenFramebuffers(int count, unsigned *names) {
    NEXT(glGenFramebuffers);
    if (!refused(missing("GL_ARB_framebuffer_object", 3.0), "glGenFramebuffers", 0)) next(count, names);
}

void glFogCoordPointer(Enum type, int stride, const void *pointer) {
    NEXT(glFogCoordPointer);
    if (!refused(missing("GL_EXT_fog_coord", 1.4), "glFogCoordPointer", type)) next(type, stride, pointer);
}

void glBeginQuery(Enum target, unsigned name) {
    NEXT(glBeginQuery);
    if (!refused(missing("GL_ARB_occlusion_query", 1.5), "glBeginQuery", target)) next(target, name);
}

void glLineWidth(float width) {
    NEXT(glLineWidth);
    next(refused(thin() && width > 1, "glLineWidth", (Enum)width) ? 1 : width);
}

Enum glGetError(void) {
    NEXT(glGetError);
    Enum error = pending;
    pending = 0;
    return error ? error : next();
}

void glGetIntegerv(Enum name, int *values) {
    NEXT(glGetIntegerv);
    next(name, values);
    if (name == UNITS && *values > units()) *values = units();
}

void glGetFloatv(Enum name, float *values) {
    NEXT(glGetFloatv);
    next(name, values);
    if (name == UNITS && *values > units()) *values = (float)units();
    if (thin() && (name == LINES || name == SMOOTH_LINES)) values[0] = values[1] = 1;
}

/* Returns the names in a list that are not hidden; the memory is never freed. */
static const char *without_hidden(const char *all) {
    char *kept = calloc(1, strlen(all) + 2);
    while (*all) {
        size_t length = strcspn(all, " ");
        if (length && !hidden(all, length)) {
            strncat(kept, all, length);
            strcat(kept, " ");
        }
        all += length + strspn(all + length, " ");
    }
    return kept;
}

const unsigned char *glGetString(Enum name) {
    NEXT(glGetString);
    static const char *extensions;
    if (name == VERSION && asked("DRIVER_VERSION")) return (const unsigned char *)asked("DRIVER_VERSION");
    const unsigned char *whole = next(name);
    if (name != EXTENSIONS || !whole) return whole;
    if (!extensions) extensions = without_hidden((const char *)whole);
    return (const unsigned char *)extensions;
}

Function OSMesaGetProcAddress(const char *name) {
    NEXT(OSMesaGetProcAddress);
    static const struct { const char *name; void *function; } own[] = {
#define OWN(name) {#name, name}
        OWN(glActiveTexture), OWN(glEnable), OWN(glTexEnvi), OWN(glTexEnvf), OWN(glGenFramebuffers),
        OWN(glFogCoordPointer), OWN(glBeginQuery), OWN(glLineWidth), OWN(glGetError),
        OWN(glGetIntegerv), OWN(glGetFloatv), OWN(glGetString),
    };
    for (unsigned k = 0; k < sizeof own / sizeof *own; k++)
        if (!strcmp(name, own[k].name)) return (Function)own[k].function;
    return next(name);
}
