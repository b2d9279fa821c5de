// The page that plays a recording.
#pragma once

#include <string>
#include <string_view>

namespace fc {

// The page viewer.html, which is built into the program, with the title and the bytes of a binary glTF file
// embedded: it needs no other file.
std::string motion_page(std::string_view title, std::string_view glb);

}  // namespace fc
