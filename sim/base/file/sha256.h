// The SHA-256 of an input's bytes; a result names its inputs by it.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace vegard::sim {

/// The digest of bytes that come one piece after another (FIPS 180-4, section 6.2). How they are cut does not
/// matter.
class Sha256 {
 public:
  Sha256();
  void add(std::string_view bytes);

  /// Of all bytes so far, as 64 lower-case hexadecimal digits.
  std::string digest() const;

 private:
  std::array<std::uint32_t, 8> state_;
  std::string rest_;          ///< less than a block
  std::uint64_t length_ = 0;  ///< bytes, all of them
};

/// Of these bytes.
std::string sha256(std::string_view bytes);

/// Of a file, of which a megabyte is held at a time. One that cannot be read counts as empty: whoever reads
/// what is in it says so.
std::string sha256_of_file(const std::string& path);

}  // namespace vegard::sim
