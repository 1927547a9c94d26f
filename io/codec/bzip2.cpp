// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Unpacks bzip2.
#include <bzlib.h>

#include <memory>

#include "io/codec/codec.h"
#include "io/codec/stream.h"

namespace mw::io {
namespace {

class Bunzipper : public StreamDecoder {
 public:
  explicit Bunzipper(const PackedName& name) : name_(name) { start(); }
  ~Bunzipper() override { BZ2_bzDecompressEnd(&stream_); }
  Bunzipper(const Bunzipper&) = delete;
  Bunzipper& operator=(const Bunzipper&) = delete;

  [[nodiscard]] Step step(std::span<const std::byte> packed, std::span<std::byte> out) override {
    // libbz2 does not write to its input.
    stream_.next_in = reinterpret_cast<char*>(const_cast<std::byte*>(packed.data()));
    stream_.avail_in = static_cast<unsigned>(packed.size());
    stream_.next_out = reinterpret_cast<char*>(out.data());
    stream_.avail_out = static_cast<unsigned>(out.size());
    const int verdict = BZ2_bzDecompress(&stream_);
    if (verdict == BZ_MEM_ERROR) fail_no_memory(name_);
    return {.taken = packed.size() - stream_.avail_in,
            .given = out.size() - stream_.avail_out,
            .ended = verdict == BZ_STREAM_END,
            .wrong = verdict == BZ_OK || verdict == BZ_STREAM_END ? nullptr : "damaged"};
  }
  void restart() override {
    BZ2_bzDecompressEnd(&stream_);
    start();
  }

 private:
  void start() {
    stream_ = {};
    if (BZ2_bzDecompressInit(&stream_, /*verbosity=*/0, /*small=*/0) != BZ_OK) {
      fail_no_memory(name_);
    }
  }

  PackedName name_;
  bz_stream stream_{};
};

}  // namespace

std::unique_ptr<StreamDecoder> bzip2_decoder(const PackedName& name) {
  return std::make_unique<Bunzipper>(name);
}

}  // namespace mw::io
