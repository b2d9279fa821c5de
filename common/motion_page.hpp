// The page that plays a recording.
#pragma once

#include <string>
#include <string_view>

namespace fc {

// The page viewer.html, which is built into the program, with the title and the bytes of a binary glTF file
// in it: one file that needs nothing else.
std::string motion_page(std::string_view title, std::string_view glb);

}  // namespace fc
