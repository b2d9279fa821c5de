#include "common/motion_page.hpp"

#include <cstdint>
#include <stdexcept>

namespace fc {

extern const std::string_view
    kViewerPage;  // common/viewer.html and common/viewer: CMake makes the source that has it

namespace {

std::string base64(std::string_view bytes) {
  static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t left = bytes.size() - i;
    std::uint32_t three = 0;
    for (std::size_t k = 0; k < 3; ++k)
      three = three << 8 | (k < left ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k) text += k <= left ? digits[three >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

std::string as_html(std::string_view text) {
  std::string html;
  for (const char c : text)
    if (c == '<')
      html += "&lt;";
    else if (c == '&')
      html += "&amp;";
    else
      html += c;
  return html;
}

void replace_once(std::string& page, std::string_view mark, const std::string& text) {
  const std::size_t at = page.find(mark);
  if (at == std::string::npos || page.find(mark, at + 1) != std::string::npos)
    throw std::logic_error("viewer.html must have the mark " + std::string(mark) + " exactly once");
  page.replace(at, mark.size(), text);
}

}  // namespace

std::string motion_page(std::string_view title, std::string_view glb) {
  std::string page(kViewerPage);
  replace_once(page, "MOTION_TITLE", as_html(title));
  replace_once(page, "MOTION_GLB_BASE64", base64(glb));
  return page;
}

std::string live_page(std::string_view title) {
  return motion_page(title, {});
}

}  // namespace fc
