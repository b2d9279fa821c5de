// The page that plays a recording, or shows a scene while it runs.
#pragma once

#include <string>
#include <string_view>

namespace fc {

// The page viewer.html, which is built into the program, with the title and the bytes of a binary glTF file
// embedded: it needs no other file.
std::string motion_page(std::string_view title, std::string_view glb);

// The same page without a recording: it takes `key` from its own address, and asks the server that it comes from for the scene
// (common/live/STREAM.md).
std::string live_page(std::string_view title);

}  // namespace fc
