#include "sim/base/file/byte_stream.h"

#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <cassert>
#include <cerrno>
#include <cstring>
#include <new>
#include <system_error>
#include <utility>
#include <vector>

#include "sim/base/error.h"
#include "sim/base/file/input_file.h"

namespace vegard::sim {
namespace {

constexpr std::size_t kPackedBlock = 1 << 16;
constexpr int kGzipOnly = 16;  // added to zlib's number of window bits

/// The bytes of a file or in memory, one after another.
class PlainBytes {
 public:
  explicit PlainBytes(const std::string& path) : file_(path) {}
  PlainBytes(std::string_view bytes, std::string name)
      : file_(std::move(name), bytes.data() != nullptr ? bytes : std::string_view("")) {}

  const std::string& name() const { return file_.name(); }

  std::size_t read(char* to, std::size_t count) {
    const std::size_t done = file_.read(at_, to, count);
    at_ += done;
    return done;
  }

  std::uint64_t skip(std::uint64_t count) {
    count = std::min(count, file_.size() - std::min(file_.size(), at_));
    at_ += count;
    return count;
  }

 private:
  RandomBytes file_;
  std::uint64_t at_ = 0;
};

/// Unpacks data of gzip or zlib, of which `begun` are the first bytes.
class Unpacker {
 public:
  Unpacker(PlainBytes& from, std::string_view begun, bool is_gzip)
      : from_(from), packed_(begun.begin(), begun.end()), is_gzip_(is_gzip) {
    packed_.resize(std::max(packed_.size(), kPackedBlock));
    stream_.next_in = reinterpret_cast<Bytef*>(packed_.data());
    stream_.avail_in = static_cast<uInt>(begun.size());
    if (inflateInit2(&stream_, MAX_WBITS + (is_gzip ? kGzipOnly : 0)) != Z_OK) throw std::bad_alloc();
  }
  ~Unpacker() { inflateEnd(&stream_); }
  Unpacker(const Unpacker&) = delete;
  Unpacker& operator=(const Unpacker&) = delete;

  std::size_t read(char* to, std::size_t count) {
    std::size_t done = 0;
    while (done < count && !ended_) {
      if (stream_.avail_in == 0 && !refill())
        throw truncated(from_.name(), std::string("its ") + word() + " data end early");
      constexpr std::size_t kAtOnce = std::size_t{1} << 30;  // zlib counts in unsigned int
      const auto room = static_cast<uInt>(std::min(count - done, kAtOnce));
      stream_.next_out = reinterpret_cast<Bytef*>(to + done);
      stream_.avail_out = room;
      const int code = inflate(&stream_, Z_NO_FLUSH);
      done += room - stream_.avail_out;
      if (code == Z_MEM_ERROR) throw std::bad_alloc();
      if (code == Z_STREAM_END)
        end_of_member();
      else if (code != Z_OK && code != Z_BUF_ERROR)
        throw bad_data(stream_.msg != nullptr ? stream_.msg : "they make no sense");
    }
    unpacked_ += done;
    if (unpacked_ > kMaxUnpackedBytes)
      throw unreadable(from_.name(), "unpacks to more than " + bytes_text(kMaxUnpackedBytes))
          .hint("unpack it, and cut it up");
    return done;
  }

 private:
  bool refill() {
    stream_.next_in = reinterpret_cast<Bytef*>(packed_.data());
    stream_.avail_in = static_cast<uInt>(from_.read(packed_.data(), packed_.size()));
    return stream_.avail_in > 0;
  }

  bool has_more() { return stream_.avail_in > 0 || refill(); }

  /// gzip files one behind the other are one (RFC 1952, 2.2); tapes leave zeros behind the last.
  void end_of_member() {
    if (!is_gzip_ || !has_more()) {
      ended_ = true;
    } else if (*stream_.next_in != 0) {
      if (inflateReset(&stream_) != Z_OK) throw std::bad_alloc();
      constexpr Bytef kFirstOfGzip = 0x1f;
      if (*stream_.next_in != kFirstOfGzip) throw bad_data("something else follows them");
    } else {
      for (; has_more(); stream_.avail_in = 0)
        if (std::any_of(stream_.next_in, stream_.next_in + stream_.avail_in, [](Bytef b) { return b != 0; }))
          throw bad_data("something else follows them");
      ended_ = true;
    }
  }

  Error bad_data(const std::string& why) const {
    return damaged(from_.name(), std::string("of its ") + word() + " data, " + why);
  }

  const char* word() const { return is_gzip_ ? "gzip" : "zlib"; }

  PlainBytes& from_;
  std::vector<char> packed_;
  bool is_gzip_;
  z_stream stream_{};
  std::uint64_t unpacked_ = 0;
  bool ended_ = false;
};

}  // namespace

struct ByteStream::Source {
  struct OfZlib {};
  Source(OfZlib, std::string_view bytes, const std::string& name)
      : plain(bytes, name), unpacker(std::make_unique<Unpacker>(plain, std::string_view(), false)) {}
  template <typename... Words>
  explicit Source(Words&&... words) : plain(std::forward<Words>(words)...) {
    fill(2);
    if (!is_gzip({shown.data(), end})) return;
    unpacker = std::make_unique<Unpacker>(plain, std::string_view(shown.data(), end), true);
    end = 0;
  }

  std::size_t fetch(char* to, std::size_t count) {
    return unpacker ? unpacker->read(to, count) : plain.read(to, count);
  }

  /// Until at least `count` bytes are shown, or there are no more.
  void fill(std::size_t count) {
    if (end - begin >= count) return;
    std::memmove(shown.data(), shown.data() + begin, end - begin);
    end -= begin;
    begin = 0;
    end += fetch(shown.data() + end, count - end);
  }

  PlainBytes plain;
  std::unique_ptr<Unpacker> unpacker;
  std::vector<char> shown = std::vector<char>(kMaxPeekBytes);  ///< looked at, not yet read: [begin, end)
  std::size_t begin = 0, end = 0;
  std::uint64_t position = 0;
};

ByteStream::ByteStream(const std::string& path) : source_(std::make_unique<Source>(path)) {}
ByteStream::ByteStream(std::string_view bytes, const std::string& name)
    : source_(std::make_unique<Source>(bytes, name)) {}
ByteStream::ByteStream(std::unique_ptr<Source> source) : source_(std::move(source)) {}
ByteStream ByteStream::of_zlib(std::string_view bytes, const std::string& name) {
  return ByteStream(std::make_unique<Source>(Source::OfZlib(), bytes, name));
}
ByteStream::~ByteStream() = default;
ByteStream::ByteStream(ByteStream&&) noexcept = default;
ByteStream& ByteStream::operator=(ByteStream&&) noexcept = default;

bool ByteStream::is_packed() const { return source_->unpacker != nullptr; }

std::uint64_t ByteStream::position() const { return source_->position; }

std::string_view ByteStream::look(std::size_t count) {
  assert(count <= kMaxPeekBytes);
  source_->fill(count);
  return {source_->shown.data() + source_->begin, std::min(count, source_->end - source_->begin)};
}

std::size_t ByteStream::read(char* to, std::size_t count) {
  Source& s = *source_;
  const std::size_t shown = std::min(count, s.end - s.begin);
  std::copy_n(s.shown.data() + s.begin, shown, to);
  s.begin += shown;
  const std::size_t done = shown + (count > shown ? s.fetch(to + shown, count - shown) : 0);
  s.position += done;
  return done;
}

std::uint64_t ByteStream::skip(std::uint64_t count) {
  Source& s = *source_;
  const std::uint64_t shown = std::min<std::uint64_t>(count, s.end - s.begin);
  s.begin += static_cast<std::size_t>(shown);
  std::uint64_t done = shown;
  if (s.unpacker == nullptr) {
    done += s.plain.skip(count - shown);
  } else if (count > shown) {
    // Nothing is shown any more: its room serves for what is not kept.
    s.begin = s.end = 0;
    while (done < count) {
      const std::size_t got = s.fetch(
          s.shown.data(), static_cast<std::size_t>(std::min<std::uint64_t>(count - done, s.shown.size())));
      if (got == 0) break;
      done += got;
    }
  }
  s.position += done;
  return done;
}

bool is_gzip(std::string_view bytes) { return bytes.size() >= 2 && bytes[0] == '\x1f' && bytes[1] == '\x8b'; }

RandomBytes::RandomBytes(std::string name, std::string_view bytes)
    : name_(std::move(name)), bytes_(bytes), size_(bytes.size()) {
  if (bytes.data() != nullptr) return;
  std::string problem;
  descriptor_ = open_input(name_, problem, size_);
  if (descriptor_ < 0) throw unreadable(name_, problem);
}

RandomBytes::~RandomBytes() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

std::size_t RandomBytes::read(std::uint64_t place, char* to, std::size_t count) const {
  if (descriptor_ < 0) {
    const std::string_view there = bytes_.substr(std::min(size_, static_cast<std::size_t>(place)), count);
    std::copy(there.begin(), there.end(), to);
    return there.size();
  }
  std::size_t done = 0;
  while (done < count) {
    const ssize_t got = ::pread(descriptor_, to + done, count - done, static_cast<off_t>(place + done));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) throw unreadable(name_, "cannot be read: " + std::generic_category().message(errno));
    if (got == 0) break;
    done += static_cast<std::size_t>(got);
  }
  return done;
}

std::string RandomBytes::bytes(std::uint64_t place, std::uint64_t count) const {
  std::string all;
  if (place <= size_ && count <= size_ - place) {
    all.resize(static_cast<std::size_t>(count));
    all.resize(read(place, all.data(), all.size()));
  }
  if (all.size() != count)
    throw unreadable(name_, "the file is truncated, or damaged: what it points to lies behind its end")
        .hint(kCopyAgain);
  return all;
}

std::string gzipped(std::string_view bytes) {
  constexpr int kMemoryLevel = 8;
  z_stream stream{};
  if (::deflateInit2(&stream, Z_DEFAULT_COMPRESSION, Z_DEFLATED, MAX_WBITS + kGzipOnly, kMemoryLevel,
                     Z_DEFAULT_STRATEGY) != Z_OK)
    throw std::bad_alloc();
  std::string packed;
  // NOLINTNEXTLINE: zlib does not change what it reads
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  int state = Z_OK;
  // Both sides piece by piece: zlib counts in 32 bits.
  std::size_t left = bytes.size();
  char block[kPackedBlock];
  do {
    if (stream.avail_in == 0) {
      stream.avail_in = static_cast<uInt>(std::min<std::size_t>(left, 1u << 30));
      left -= stream.avail_in;
    }
    stream.next_out = reinterpret_cast<Bytef*>(block);
    stream.avail_out = sizeof block;
    state = ::deflate(&stream, left == 0 ? Z_FINISH : Z_NO_FLUSH);
    packed.append(block, sizeof block - stream.avail_out);
  } while (state != Z_STREAM_END);
  ::deflateEnd(&stream);
  return packed;
}

}  // namespace vegard::sim
