// SHA-256 digests, by which results identify their inputs.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace vegard::sim {

/// The digest of bytes that are added piece by piece (FIPS 180-4, section 6.2). It does not depend on the
/// sizes of the pieces.
class Sha256 {
 public:
  Sha256();
  void add(std::string_view bytes);

  /// Returns the digest of all bytes so far, as 64 lower-case hexadecimal digits.
  std::string digest() const;

 private:
  std::array<std::uint32_t, 8> state_;
  std::string rest_;          ///< bytes of an incomplete block
  std::uint64_t length_ = 0;  ///< number of all bytes
};

/// Returns the digest of these bytes.
std::string sha256(std::string_view bytes);

/// Returns the digest of a file, read in pieces of a megabyte. A file that cannot be read counts as empty:
/// the code that reads its content reports the error.
std::string sha256_of_file(const std::string& path);

}  // namespace vegard::sim
