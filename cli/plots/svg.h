// Writes drawings as SVG: shapes and text in pixels, x right, y down.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace lfd::plots {

struct Place {
  double x = 0, y = 0;
};

struct Box {
  double x = 0, y = 0, width = 0, height = 0;
};

// Colours are those of SVG: "#rrggbb" or names; "none" draws nothing.
struct Pen {
  std::string stroke = "none";
  std::string fill = "none";
  double width_px = 1;
  std::string dashes = {};  // "4 3"; empty: a full line
};

enum class Anchor { kStart, kMiddle, kEnd };

struct TextStyle {
  double size_px = 12;
  Anchor anchor = Anchor::kStart;
  std::string colour = "#222222";
  bool is_bold = false;
  bool is_upright = false;  // turned by a quarter, reading from below
};

// A shape with a coordinate that is not finite is left out.
class Svg {
 public:
  // White, of this size.
  Svg(double width_px, double height_px);

  void rectangle(const Box& box, const Pen& pen);
  void line(Place from, Place to, const Pen& pen);
  void polyline(const std::vector<Place>& places, const Pen& pen);
  void polygon(const std::vector<Place>& places, const Pen& pen);
  void circle(Place centre, double radius_px, const Pen& pen);
  // A line with a head, which shrinks with short arrows.
  void arrow(Place from, Place to, const std::string& colour);
  void text(Place at, std::string_view text, const TextStyle& style);

  // Until end_group: what is drawn is seen inside the box only; edges are not smoothed, so that neighbours join.
  void begin_clip(const Box& box);
  void begin_crisp();
  void end_group();

  // The whole file.
  std::string finish() const;

 private:
  void path(std::string_view element, const std::vector<Place>& places, const Pen& pen);

  double width_px_, height_px_;
  int clips_ = 0;
  std::string body_;
};

}  // namespace lfd::plots
