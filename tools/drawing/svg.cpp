#include "tools/drawing/svg.h"

#include <array>
#include <cassert>
#include <charconv>

#include "graph/text/escape.h"

namespace jarol::tools {

std::string fixed(double number, int decimals) {
  std::array<char, 400> digits;  // more than the largest double has
  const auto result =
      std::to_chars(digits.data(), digits.data() + digits.size(), number, std::chars_format::fixed, decimals);
  return {digits.data(), result.ptr};
}

std::string px(double number) {
  std::string text = fixed(number, 2);
  while (text.back() == '0') text.pop_back();
  if (text.back() == '.') text.pop_back();
  return text == "-0" ? "0" : text;
}

void Svg::tag(std::string_view name, const SvgAttributes& attributes) {
  text_.append("<").append(name);
  for (const SvgAttribute& each : attributes)
    text_.append(" ").append(each.name).append("=\"").append(xml_attribute(each.value)).append("\"");
}

Svg& Svg::declaration() {
  text_ += "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
  return *this;
}

Svg& Svg::begin(std::string_view name, const SvgAttributes& attributes) {
  tag(name, attributes);
  text_ += ">";
  open_.emplace_back(name);
  return *this;
}

Svg& Svg::end() {
  assert(!open_.empty());
  text_.append("</").append(open_.back()).append(">");
  open_.pop_back();
  return *this;
}

Svg& Svg::element(std::string_view name, const SvgAttributes& attributes) {
  tag(name, attributes);
  text_ += "/>";
  return *this;
}

Svg& Svg::element(std::string_view name, const SvgAttributes& attributes, std::string_view words) {
  return begin(name, attributes).words(words).end();
}

Svg& Svg::words(std::string_view words) {
  text_ += xml_text(words);
  return *this;
}

Svg& Svg::line_end() {
  text_ += "\n";
  return *this;
}

Svg& Svg::style(std::string_view rules) {
  text_.append("<style>\n").append(rules).append("</style>\n");
  return *this;
}

}  // namespace jarol::tools
