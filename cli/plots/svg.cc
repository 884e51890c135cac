// Elements of SVG, one a line.
#include "cli/plots/svg.h"

#include <algorithm>
#include <cmath>

#include "base/log.h"

namespace lfd::plots {
namespace {

bool is_finite(Place p) { return std::isfinite(p.x) && std::isfinite(p.y); }
bool is_finite(const Box& b) {
  return std::isfinite(b.x) && std::isfinite(b.y) && std::isfinite(b.width) && std::isfinite(b.height);
}

std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        if (static_cast<unsigned char>(c) >= 0x20) result += c;  // XML has no place for control characters
    }
  }
  return result;
}

std::string attributes(const Pen& pen) {
  std::string text = fmt::format(R"(fill="{}" stroke="{}")", escaped(pen.fill), escaped(pen.stroke));
  if (pen.stroke != "none") text += fmt::format(R"( stroke-width="{:.2f}")", pen.width_px);
  if (!pen.dashes.empty()) text += fmt::format(R"( stroke-dasharray="{}")", escaped(pen.dashes));
  return text;
}

}  // namespace

Svg::Svg(double width_px, double height_px) : width_px_(width_px), height_px_(height_px) {
  rectangle({0, 0, width_px, height_px}, {.fill = "white"});
}

void Svg::rectangle(const Box& box, const Pen& pen) {
  if (!is_finite(box)) return;
  body_ += fmt::format("<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\" {}/>\n", box.x, box.y,
                       box.width, box.height, attributes(pen));
}

void Svg::line(Place from, Place to, const Pen& pen) { polyline({from, to}, pen); }
void Svg::polyline(const std::vector<Place>& places, const Pen& pen) { path("polyline", places, pen); }
void Svg::polygon(const std::vector<Place>& places, const Pen& pen) { path("polygon", places, pen); }

void Svg::path(std::string_view element, const std::vector<Place>& places, const Pen& pen) {
  if (!std::ranges::all_of(places, [](Place p) { return is_finite(p); })) return;
  std::string points;
  for (const Place& p : places) points += fmt::format("{}{:.2f},{:.2f}", points.empty() ? "" : " ", p.x, p.y);
  body_ += fmt::format("<{} points=\"{}\" {}/>\n", element, points, attributes(pen));
}

void Svg::circle(Place centre, double radius_px, const Pen& pen) {
  if (!is_finite(centre)) return;
  body_ += fmt::format("<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"{:.2f}\" {}/>\n", centre.x, centre.y, radius_px,
                       attributes(pen));
}

void Svg::arrow(Place from, Place to, const std::string& colour) {
  const double dx = to.x - from.x, dy = to.y - from.y, length = std::hypot(dx, dy);
  line(from, to, {.stroke = colour, .width_px = 1.3});
  if (!(length > 0)) return;
  const double head = std::min(7.0, 0.5 * length), half = 0.4 * head;
  const double x = dx / length, y = dy / length;
  const Place neck{to.x - head * x, to.y - head * y};
  polygon({to, {neck.x - half * y, neck.y + half * x}, {neck.x + half * y, neck.y - half * x}}, {.fill = colour});
}

void Svg::text(Place at, std::string_view text, const TextStyle& style) {
  if (!is_finite(at)) return;
  constexpr const char* kAnchors[] = {"start", "middle", "end"};
  const std::string turn = style.is_upright ? fmt::format(" transform=\"rotate(-90 {:.2f} {:.2f})\"", at.x, at.y) : "";
  body_ += fmt::format(
      "<text x=\"{:.2f}\" y=\"{:.2f}\" font-size=\"{:.1f}\" text-anchor=\"{}\" fill=\"{}\"{}{}>{}"
      "</text>\n",
      at.x, at.y, style.size_px, kAnchors[static_cast<int>(style.anchor)], escaped(style.colour),
      style.is_bold ? " font-weight=\"bold\"" : "", turn, escaped(text));
}

void Svg::begin_clip(const Box& box) {
  body_ += fmt::format(
      "<clipPath id=\"clip{}\"><rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\"/>"
      "</clipPath>\n<g clip-path=\"url(#clip{})\">\n",
      clips_, box.x, box.y, box.width, box.height, clips_);
  ++clips_;
}

void Svg::begin_crisp() { body_ += "<g shape-rendering=\"crispEdges\">\n"; }

void Svg::end_group() { body_ += "</g>\n"; }

std::string Svg::finish() const {
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" "
      "viewBox=\"0 0 {0:.0f} {1:.0f}\" font-family=\"DejaVu Sans, Arial, sans-serif\">\n{2}</svg>\n",
      width_px_, height_px_, body_);
}

}  // namespace lfd::plots
