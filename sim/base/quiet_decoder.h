// libpng, libjpeg, libtiff, OpenCV, LibRaw and OpenVDB write to the terminal what they think of a file. What
// is to be known of it is in the Error that is thrown; beside it their words are noise, and no library of
// ours prints.
#pragma once

namespace vegard::sim {

/// While there is one of these, in whatever thread, what the process writes to its standard error is lost. To
/// be held around the call of a decoder and no longer.
class QuietDecoder {
 public:
  QuietDecoder();
  ~QuietDecoder();
  QuietDecoder(const QuietDecoder&) = delete;
  QuietDecoder& operator=(const QuietDecoder&) = delete;
};

/// Where words for standard error go at this moment, past a decoder that is silenced. A signal handler may ask.
int error_stream();

}  // namespace vegard::sim
