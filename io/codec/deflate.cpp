// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Unpacks gzip and zlib.
#include <zlib.h>

#include <memory>

#include "io/codec/codec.h"
#include "io/codec/stream.h"

namespace mw::io {
namespace {

constexpr int kZlib = 15;       // zlib's window bits: largest window, its own framing
constexpr int kGzip = 15 + 16;  // the same window, gzip's framing

class DeflateDecoder : public StreamDecoder {
 public:
  DeflateDecoder(int window_bits, const PackedName& name) {
    if (inflateInit2(&stream_, window_bits) != Z_OK) fail_no_memory(name);
  }
  ~DeflateDecoder() override { inflateEnd(&stream_); }
  DeflateDecoder(const DeflateDecoder&) = delete;
  DeflateDecoder& operator=(const DeflateDecoder&) = delete;

  [[nodiscard]] Step step(std::span<const std::byte> packed, std::span<std::byte> out) override {
    // zlib does not write to its input.
    stream_.next_in = reinterpret_cast<Bytef*>(const_cast<std::byte*>(packed.data()));
    stream_.avail_in = static_cast<uInt>(packed.size());
    stream_.next_out = reinterpret_cast<Bytef*>(out.data());
    stream_.avail_out = static_cast<uInt>(out.size());
    const int verdict = inflate(&stream_, Z_NO_FLUSH);
    Step step{.taken = packed.size() - stream_.avail_in,
              .given = out.size() - stream_.avail_out,
              .ended = verdict == Z_STREAM_END};
    if (verdict != Z_OK && verdict != Z_STREAM_END && verdict != Z_BUF_ERROR) {
      step.wrong = stream_.msg != nullptr ? stream_.msg : "damaged";
    }
    return step;
  }
  void restart() override { inflateReset(&stream_); }

 private:
  z_stream stream_{};
};

}  // namespace

std::unique_ptr<StreamDecoder> gzip_decoder(const PackedName& name) {
  return std::make_unique<DeflateDecoder>(kGzip, name);
}

std::unique_ptr<StreamDecoder> zlib_decoder(const PackedName& name) {
  return std::make_unique<DeflateDecoder>(kZlib, name);
}

}  // namespace mw::io
