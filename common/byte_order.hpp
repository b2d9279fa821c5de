// Numbers from the bytes of a file, whatever the byte order of this machine.
#pragma once

#include <algorithm>
#include <bit>
#include <cstring>

namespace fc {

enum class ByteOrder { little, big };

template <class Number>
Number from_bytes(const char* bytes, ByteOrder order) {
  char copy[sizeof(Number)];
  std::memcpy(copy, bytes, sizeof(Number));
  if ((order == ByteOrder::little) != (std::endian::native == std::endian::little)) {
    std::reverse(copy, copy + sizeof(Number));
  }
  Number number;
  std::memcpy(&number, copy, sizeof(Number));
  return number;
}

}  // namespace fc
