/* A straightforward fly-over in C, for comparison: `make peer` exports an environment, builds and
   runs it.

       flyover FOLDER [WIDTH HEIGHT] [PICTURE.pgm]

   FOLDER is what `landscape flyover --export` has written. It draws the terrain of heights.bmp
   alone, without its mirror images, in wire frame as the document asks for: each triangle's lines
   by Bresenham, from the places of flight.csv. Points outside the view volume are not projected.
   There are no strips, no levels of detail and no tree. It prints the mean time of a frame. */

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { MOST_PLACES = 100000, LINE = 256 };
static const double NEAR = 1.5, FAR = 4096.0, RELIEF = 64.0;

typedef struct { double x, y, z, theta_x, theta_y, theta_z; } Place;
typedef struct { int column, row, seen; } Point;

static int width = 1024, height = 768;
static uint8_t *picture;

static void fail(const char *what, const char *name) {
    fprintf(stderr, "flyover: %s: %s\n", name, what);
    exit(2);
}

/* Return the pixels of a BMP of 8 bits, top row first; `side` becomes its width. */
static uint8_t *read_heights(const char *name, int *side) {
    FILE *file = fopen(name, "rb");
    uint8_t head[54];
    if (!file || fread(head, 1, sizeof head, file) != sizeof head || head[0] != 'B')
        fail("expected a BMP", name);
    int32_t begin, columns, rows;
    memcpy(&begin, head + 10, 4);
    memcpy(&columns, head + 18, 4);
    memcpy(&rows, head + 22, 4);
    if (head[28] != 8 || columns < 2 || columns > 4096 || rows != columns || columns % 4)
        fail("expected a square of 8 bits a pixel", name);
    uint8_t *pixels = malloc((size_t)rows * columns);
    fseek(file, begin, SEEK_SET);
    for (int row = rows - 1; row >= 0; row--)
        if (fread(pixels + (size_t)row * columns, 1, columns, file) != (size_t)columns)
            fail("too short", name);
    fclose(file);
    *side = columns;
    return pixels;
}

static int read_places(const char *name, Place *places) {
    FILE *file = fopen(name, "r");
    char line[LINE];
    int count = 0;
    if (!file || !fgets(line, sizeof line, file)) fail("expected a flight", name);
    while (count < MOST_PLACES && fgets(line, sizeof line, file)) {
        Place *at = &places[count];
        count += sscanf(line, "%*f,%lf,%lf,%lf,%lf,%lf,%lf", &at->x, &at->y, &at->z, &at->theta_x,
                        &at->theta_y, &at->theta_z) == 6;
    }
    fclose(file);
    return count;
}

/* The document's camera transform: about z, then y, then x; x is the way forward, y to the right. */
static Point project(const Place *eye, double x, double y, double z) {
    double dx = x - eye->x, dy = y - eye->y, dz = z - eye->z;
    double cz = cos(eye->theta_z), sz = sin(eye->theta_z);
    double cy = cos(eye->theta_y), sy = sin(eye->theta_y);
    double cx = cos(eye->theta_x), sx = sin(eye->theta_x);
    double forward = cz * dx + sz * dy, right = cz * dy - sz * dx;
    double ahead = cy * forward - sy * dz, up = sy * forward + cy * dz;
    double across = cx * right + sx * up, above = cx * up - sx * right;
    double wide = (double)width / height;
    Point found = {0, 0, ahead >= NEAR && ahead <= FAR};
    if (!found.seen) return found;
    double column = across * NEAR / ahead, row = above * NEAR / ahead;
    found.seen = fabs(column) <= wide && fabs(row) <= 1.0;
    found.column = (int)ceil((column + wide) / (2 * wide) * (width - 1));
    found.row = (int)ceil((1.0 - row) / 2 * (height - 1));
    return found;
}

static void line(Point a, Point b) {
    if (!a.seen || !b.seen) return;
    int dx = abs(b.column - a.column), dy = -abs(b.row - a.row);
    int right = a.column < b.column ? 1 : -1, down = a.row < b.row ? 1 : -1, error = dx + dy;
    for (;;) {
        picture[(size_t)a.row * width + a.column] = 0;
        if (a.column == b.column && a.row == b.row) return;
        int twice = 2 * error;
        if (twice >= dy) { error += dy; a.column += right; }
        if (twice <= dx) { error += dx; a.row += down; }
    }
}

static void draw(const Place *eye, const uint8_t *heights, int side, Point *points) {
    memset(picture, 255, (size_t)width * height);
    for (int y = 0; y < side; y++)
        for (int x = 0; x < side; x++) {
            double z = (255 - heights[(size_t)y * side + x]) * RELIEF / 255;
            points[(size_t)y * side + x] = project(eye, x, y, z);
        }
    for (int y = 0; y + 1 < side; y++)
        for (int x = 0; x + 1 < side; x++) {
            const Point *a = points + (size_t)y * side + x, *b = a + side;
            line(a[0], a[1]);
            line(a[0], b[0]);
            line(a[1], b[0]);
        }
}

int main(int count, char **words) {
    if (count < 2) fail("FOLDER [WIDTH HEIGHT] [PICTURE.pgm]", "usage");
    if (count > 3) width = atoi(words[2]), height = atoi(words[3]);
    if (width < 2 || height < 2 || width > 8192 || height > 8192) fail("not a size", words[2]);
    char name[4096];
    int side;
    snprintf(name, sizeof name, "%s/heights.bmp", words[1]);
    uint8_t *heights = read_heights(name, &side);
    Place *places = malloc(MOST_PLACES * sizeof *places);
    snprintf(name, sizeof name, "%s/flight.csv", words[1]);
    int frames = read_places(name, places);
    picture = malloc((size_t)width * height);
    Point *points = malloc((size_t)side * side * sizeof *points);
    clock_t begun = clock();
    for (int frame = 0; frame < frames; frame++) draw(&places[frame], heights, side, points);
    double seconds = (double)(clock() - begun) / CLOCKS_PER_SEC;
    printf("%d x %d heights, %dx%d, %d frames: %.1f ms of the processor a frame\n", side, side, width,
           height, frames, 1e3 * seconds / (frames ? frames : 1));
    if (count > 4) {
        FILE *file = fopen(words[4], "wb");
        if (!file) fail("cannot be written", words[4]);
        fprintf(file, "P5 %d %d 255\n", width, height);
        fwrite(picture, 1, (size_t)width * height, file);
        fclose(file);
    }
    free(points), free(picture), free(places), free(heights);
    return 0;
}
