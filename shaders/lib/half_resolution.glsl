// Where the samples of half the resolution lie: at every other pixel of every other row; of odd sizes the last lie at the border.

ivec2 full_pixel(ivec2 half_pixel, ivec2 full_size) { return min(2 * half_pixel, full_size - 1); }
