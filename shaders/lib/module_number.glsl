// A module's number in the middle of its image: digits of 3 x 5 squares, as large as fit into 4/5 of the width and 3/5 of the height.

// Row by row from the top, the first square in the highest of 15 bits.
const int digit_squares[10] = int[10](0x7B6F, 0x2C97, 0x73E7, 0x73CF, 0x5BC9, 0x79CF, 0x79EF, 0x7249, 0x7BEF, 0x7BCF);

bool has_square(int digit, ivec2 square) { return ((digit_squares[digit] >> (14 - 3 * square.y - square.x)) & 1) != 0; }

// Whether the pixel lies on a digit; all counted from the top left.
bool is_on_number(int number, ivec2 size, ivec2 pixel) {
  int count = number < 10 ? 1 : number < 100 ? 2 : number < 1000 ? 3 : 4;
  ivec2 squares = ivec2(4 * count - 1, 5);  // one is left free between digits
  int side = max(1, min(4 * size.x / (5 * squares.x), 3 * size.y / (5 * squares.y)));
  ivec2 place = pixel - (size - side * squares) / 2;
  ivec2 square = place / side;
  if (any(lessThan(place, ivec2(0))) || any(greaterThanEqual(square, squares)) || square.x % 4 == 3) return false;
  for (int behind = count - 1 - square.x / 4; behind > 0; --behind) number /= 10;
  return has_square(number % 10, ivec2(square.x % 4, square.y));
}
