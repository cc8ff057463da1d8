#include "tools/drawing/pages/page.h"

#include <sodium.h>

#include <cassert>
#include <nlohmann/json.hpp>

#include "graph/text/escape.h"
#include "tools/drawing/pages/page_files.h"

namespace jarol::tools {
namespace {

std::string base64_of_bytes(const unsigned char* bytes, std::size_t count) {
  std::string text(sodium_base64_ENCODED_LEN(count, sodium_base64_VARIANT_ORIGINAL), '\0');
  sodium_bin2base64(text.data(), text.size(), bytes, count, sodium_base64_VARIANT_ORIGINAL);
  text.resize(text.size() - 1);  // its zero
  return text;
}

// As a Content-Security-Policy names what may stand in the page.
std::string hash_of(const std::string& text) {
  unsigned char hash[crypto_hash_sha256_BYTES];
  crypto_hash_sha256(hash, reinterpret_cast<const unsigned char*>(text.data()), text.size());
  return "'sha256-" + base64_of_bytes(hash, sizeof hash) + "'";
}

std::string_view file(std::string_view name) {
  for (std::size_t i = 0; i < page_file_count; ++i)
    if (page_files[i].name == name) return page_files[i].text;
  assert(false);
  return "";
}

// Several modules as one: what they import of each other stands before them.
std::string joined(const std::vector<std::string_view>& scripts) {
  std::string all;
  for (const std::string_view script : scripts) {
    const std::string_view text = file(script);
    for (std::size_t at = 0, end = 0; at < text.size(); at = end + 1) {
      end = std::min(text.find('\n', at), text.size());
      std::string_view line = text.substr(at, end - at);
      if (line.starts_with("import ")) continue;
      constexpr std::string_view exported = "export ";
      if (line.starts_with(exported)) line.remove_prefix(exported.size());
      all.append(line).append("\n");
    }
  }
  return all;
}

}  // namespace

std::string base64_of(std::span<const double> numbers) {
  return base64_of_bytes(reinterpret_cast<const unsigned char*>(numbers.data()), numbers.size_bytes());
}

std::string page_of(const std::string& title, const std::vector<std::string_view>& scripts,
                    const nlohmann::ordered_json& data) {
  const std::string style(file("page.css")), script = joined(scripts);
  // no text of the data ends its element
  std::string json;
  for (const char c : data.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace))
    if (c == '<')
      json += "\\u003c";
    else
      json += c;
  return "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
         "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; base-uri 'none'; form-action "
         "'none'; img-src data:; script-src " +
         hash_of(script) + "; style-src " + hash_of(style) +
         "\">\n<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
         "<meta name=\"color-scheme\" content=\"light dark\">\n<meta name=\"referrer\" content=\"no-referrer\">\n"
         "<link rel=\"icon\" href=\"data:,\">\n<title>" +
         xml_text(title) + "</title>\n<style>" + style +
         "</style>\n</head>\n<body>\n<noscript>This page is drawn by the script in it; allow it to run.</noscript>\n"
         "<script type=\"application/json\" id=\"data\">" +
         json + "</script>\n<script type=\"module\">" + script + "</script>\n</body>\n</html>\n";
}

}  // namespace jarol::tools
