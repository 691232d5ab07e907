#include "sim/base/grid/vdb_outline.h"

#include <cstdint>
#include <fstream>
#include <stdexcept>

#include "sim/base/file/input_file.h"

namespace vegard::sim {
namespace {

constexpr std::int64_t kMagic = 0x56444220;  // " BDV"
// 222 (OpenVDB 2.3 of 2014) is the first that says compression grid by grid; 224 is the newest.
constexpr std::uint32_t kOldest = 222, kNewest = 224;
constexpr std::int64_t kIdentity = 36, kMostText = 1 << 20, kLeastGrid = 40;

class Outline {
 public:
  explicit Outline(const std::string& path) {
    if (const std::string problem = why_no_input(path); !problem.empty()) throw std::runtime_error(problem);
    file_.open(path, std::ios::binary);
    if (!file_) throw std::runtime_error("it may not be read");
    file_.seekg(0, std::ios::end);
    size_ = file_.tellg();
    file_.seekg(0);
  }

  void follow() {
    if (size_ < 8 || number<std::int64_t>() != kMagic) throw std::runtime_error("it is no OpenVDB file");
    const auto version = number<std::uint32_t>();
    if (version < kOldest || version > kNewest)
      throw std::runtime_error("its format is of version " + std::to_string(version));
    skip(8);  // the library's version
    if (number<char>() == 0) throw std::runtime_error("it does not say where its grids are");
    skip(kIdentity);
    metadata();
    const auto grids = number<std::int32_t>();
    if (grids < 0 || grids > size_ / kLeastGrid) damaged("more grids than it has room for");
    for (std::int32_t i = 0; i < grids; ++i) grid();
  }

 private:
  [[noreturn]] static void damaged(const std::string& what) {
    throw std::runtime_error("it is damaged: " + what);
  }

  std::int64_t left() { return size_ - static_cast<std::int64_t>(file_.tellg()); }

  template <class N>
  N number() {
    N n{};
    if (left() < static_cast<std::int64_t>(sizeof n)) throw std::runtime_error("it is cut off");
    file_.read(reinterpret_cast<char*>(&n), sizeof n);
    return n;
  }

  void skip(std::int64_t bytes) {
    if (bytes > left()) throw std::runtime_error("it is cut off");
    file_.seekg(bytes, std::ios::cur);
  }

  void text() {
    const std::int64_t length = number<std::uint32_t>();
    if (length > kMostText || length > left()) damaged("a text longer than the file");
    skip(length);
  }

  void metadata() {
    const std::int64_t entries = number<std::uint32_t>();
    for (std::int64_t i = 0; i < entries; ++i) {
      text();  // name
      text();  // type
      const std::int64_t length = number<std::uint32_t>();
      if (length > left()) damaged("metadata longer than the file");
      skip(length);
    }
  }

  void grid() {
    text();  // name
    text();  // type
    text();  // whose tree it shares
    const auto begin = number<std::int64_t>(), values = number<std::int64_t>(), end = number<std::int64_t>();
    if (begin < file_.tellg() || values < begin || end < values) damaged("a grid's place");
    if (end > size_) throw std::runtime_error("it is cut off: a grid ends behind the end of the file");
    file_.seekg(begin);
    number<std::uint32_t>();  // compression
    metadata();
    if (file_.tellg() > end) damaged("a grid longer than its place");
    file_.seekg(end);
  }

  std::ifstream file_;
  std::int64_t size_ = 0;
};

}  // namespace

std::string vdb_outline_complaint(const std::string& path) {
  try {
    Outline(path).follow();
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

}  // namespace vegard::sim
