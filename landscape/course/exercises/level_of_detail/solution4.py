"""The level from the number's binary digits; the bend at the point fades out."""
# exercise: level_of_detail
# the rest: start.py


def step_at(distance):
    """Return the step of the grid at a distance from the camera."""
    # 16 has five binary digits; each further one doubles the step.
    return 1 << min(max(int(distance).bit_length() - 4, 0), 3)


def height_of(x, step, distance):
    """Return the height at which the vertex x of a grid is drawn."""
    if step < 8 and x & step:
        glide = np.clip((distance / step - 12) / 4, 0, 1)
        bend = HEIGHTS[x - step] - 2 * HEIGHTS[x] + HEIGHTS[x + step]
        return HEIGHTS[x] + glide * bend / 2
    return HEIGHTS[x]
