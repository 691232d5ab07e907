#include "sim/base/array/array_file.h"

#include <algorithm>
#include <cstring>

#include "sim/base/error.h"
#include "sim/base/file/input_file.h"

namespace vegard::sim {
namespace {

constexpr std::uint64_t kMaxCount = std::uint64_t{1} << 62;

template <typename Number>
double number_at(std::string_view block, std::size_t at) {
  Number number;
  std::memcpy(&number, block.data() + at * sizeof number, sizeof number);
  return static_cast<double>(number);
}

/// The product, or kMaxCount if it is larger.
std::uint64_t product(const std::vector<std::uint64_t>& factors) {
  std::uint64_t all = 1;
  for (const std::uint64_t factor : factors) {
    if (factor == 0) return 0;
    all = all > kMaxCount / factor ? kMaxCount : all * factor;
  }
  return all;
}

}  // namespace

std::size_t size_of(ArrayKind kind) {
  switch (kind) {
    case ArrayKind::u8:
    case ArrayKind::i8:
      return 1;
    case ArrayKind::u16:
    case ArrayKind::i16:
      return 2;
    case ArrayKind::u32:
    case ArrayKind::i32:
    case ArrayKind::f32:
      return 4;
    case ArrayKind::u64:
    case ArrayKind::i64:
    case ArrayKind::f64:
      return 8;
    case ArrayKind::text:
      return 0;
  }
  return 0;
}

std::uint64_t StoredArray::count() const { return product(dims); }

std::string ArrayFile::read(const StoredArray& array, const std::vector<std::uint64_t>& start,
                            const std::vector<std::uint64_t>& count) {
  const std::uint64_t numbers = product(count);
  const std::size_t size = size_of(array.kind);
  if (size == 0 || numbers > kMaxBlockBytes / size)
    throw unreadable(name_, "of '" + array.name + "', " + (size == 0 ? "which holds text, numbers" : "more") +
                                " would have to be read at once than is possible")
        .expected("at most " + bytes_text(kMaxBlockBytes));
  if (numbers == 0) return {};
  std::string block = read_block(array, start, count);
  if (block.size() != numbers * size)
    throw unreadable(name_, "the file is damaged: '" + array.name + "' is cut short");
  return block;
}

std::string ArrayFile::read(const StoredArray& array) {
  return read(array, std::vector<std::uint64_t>(array.dims.size(), 0), array.dims);
}

std::vector<double> ArrayFile::read_numbers(const StoredArray& array) {
  const std::string block = read(array);
  std::vector<double> numbers(block.size() / std::max<std::size_t>(1, size_of(array.kind)));
  for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = number_of(block, array.kind, i);
  return numbers;
}

std::vector<std::string> ArrayFile::read_texts(const StoredArray& array) {
  throw unreadable(name_, "'" + array.name + "' holds no texts");
}

std::string block_of(std::string_view all, const StoredArray& array, const std::vector<std::uint64_t>& start,
                     const std::vector<std::uint64_t>& count) {
  const std::size_t size = size_of(array.kind), dims = array.dims.size();
  if (dims == 0) return std::string(all.substr(0, size));
  const std::size_t run = static_cast<std::size_t>(count[dims - 1]) * size;
  std::string block;
  block.reserve(static_cast<std::size_t>(product(count)) * size);
  std::vector<std::uint64_t> at(dims, 0);
  for (;;) {
    std::uint64_t place = 0;
    for (std::size_t d = 0; d < dims; ++d) place = place * array.dims[d] + start[d] + at[d];
    if (place * size > all.size() || all.size() - place * size < run) return block;
    block.append(all.substr(static_cast<std::size_t>(place) * size, run));
    std::size_t d = dims - 1;
    while (d > 0 && ++at[d - 1] == count[d - 1]) at[--d] = 0;
    if (d == 0) return block;
  }
}

double number_of(std::string_view block, ArrayKind kind, std::size_t at) {
  switch (kind) {
    case ArrayKind::u8:
      return number_at<std::uint8_t>(block, at);
    case ArrayKind::i8:
      return number_at<std::int8_t>(block, at);
    case ArrayKind::u16:
      return number_at<std::uint16_t>(block, at);
    case ArrayKind::i16:
      return number_at<std::int16_t>(block, at);
    case ArrayKind::u32:
      return number_at<std::uint32_t>(block, at);
    case ArrayKind::i32:
      return number_at<std::int32_t>(block, at);
    case ArrayKind::u64:
      return number_at<std::uint64_t>(block, at);
    case ArrayKind::i64:
      return number_at<std::int64_t>(block, at);
    case ArrayKind::f32:
      return number_at<float>(block, at);
    case ArrayKind::f64:
      return number_at<double>(block, at);
    case ArrayKind::text:
      break;
  }
  return 0.0;
}

}  // namespace vegard::sim
