// Writes SVG: elements, their attributes, and all that has to be escaped in them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace jarol::tools {

/// With so many decimals.
std::string fixed(double number, int decimals);

/// Pixels with at most two decimals.
std::string px(double number);

struct SvgAttribute {
  std::string_view name;
  std::string value;
};
using SvgAttributes = std::vector<SvgAttribute>;

/// Names of elements and attributes are ours; values and words may come from anywhere.
class Svg {
 public:
  /// That it is XML; first of all.
  Svg& declaration();
  /// Its tag; what follows stands in it until `end`.
  Svg& begin(std::string_view name, const SvgAttributes& attributes = {});
  Svg& end();
  /// An element with nothing in it.
  Svg& element(std::string_view name, const SvgAttributes& attributes);
  /// An element with nothing but words in it.
  Svg& element(std::string_view name, const SvgAttributes& attributes, std::string_view words);
  Svg& words(std::string_view words);
  Svg& line_end();
  /// Rules of CSS, which are ours, in lines of their own.
  Svg& style(std::string_view rules);

  const std::string& text() const { return text_; }

 private:
  void tag(std::string_view name, const SvgAttributes& attributes);

  std::string text_;
  std::vector<std::string> open_;
};

}  // namespace jarol::tools
