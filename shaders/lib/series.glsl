// Angles on nearly planar screens, by series. GLSL promises nothing of the precision of atan, sin and cos, and GPUs keep a small absolute
// error only: 1e-7 rad on a screen of radius 1e6 m are 0.1 m. Here the relative error is a few roundings.

// atan(t) / t. Two halvings leave t below tan(pi / 8), where eight terms of the series are 4e-8 off, but for rounding.
float atan_over(float t) {
  float first = 1.0 + sqrt(1.0 + t * t);
  float half_t = t / first;
  float second = 1.0 + sqrt(1.0 + half_t * half_t);
  float quarter_t = half_t / second;
  float x = quarter_t * quarter_t;
  float series = 1.0 / 13.0 - x / 15.0;
  series = 1.0 / 9.0 - x * (1.0 / 11.0 - x * series);
  series = 1.0 - x * (1.0 / 3.0 - x * (1.0 / 5.0 - x * (1.0 / 7.0 - x * series)));
  return 4.0 * series / (first * second);
}

// sin(a) / a and cos(a) of at most a right angle, 1e-9 off but for rounding.
vec2 sine_over_and_cosine(float a) {
  float x = a * a;
  return vec2(1.0 - x / 6.0 * (1.0 - x / 20.0 * (1.0 - x / 42.0 * (1.0 - x / 72.0 * (1.0 - x / 110.0 * (1.0 - x / 156.0))))),
              1.0 - x / 2.0 * (1.0 - x / 12.0 * (1.0 - x / 30.0 * (1.0 - x / 56.0 * (1.0 - x / 90.0 * (1.0 - x / 132.0 *
                (1.0 - x / 182.0)))))));
}
