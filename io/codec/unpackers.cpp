// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Unpacks what libraries take piece by piece: gzip, zlib, bzip2, xz and Zstandard; and packs
// Zstandard.
#include <bzlib.h>
#include <lzma.h>
#include <zlib.h>
#include <zstd.h>
#include <zstd_errors.h>

#include <algorithm>
#include <bit>
#include <memory>
#include <new>

#include "io/codec/codec.h"
#include "io/codec/stream.h"
#include "io/file/errors.h"

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

std::vector<std::byte> inflate_all(int window_bits, std::span<const std::byte> packed,
                                   std::size_t max, const PackedName& name) {
  DeflateDecoder inflater(window_bits, name);
  return unpack_streams(inflater, packed, max, name);
}

}  // namespace

std::vector<std::byte> unpack_gzip(std::span<const std::byte> packed, std::size_t max,
                                   std::string_view name) {
  return inflate_all(kGzip, packed, max, {"gzip", name});
}

std::vector<std::byte> unpack_zlib(std::span<const std::byte> packed, std::size_t max,
                                   std::string_view name) {
  return inflate_all(kZlib, packed, max, {"zlib", name});
}

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

std::vector<std::byte> unpack_bzip2(std::span<const std::byte> packed, std::size_t max,
                                    std::string_view name) {
  const PackedName named{"bzip2", name};
  Bunzipper bunzipper(named);
  return unpack_streams(bunzipper, packed, max, named);
}

namespace {

/// Returns the reason of an error, or null for a verdict that is none.
const char* why_wrong(lzma_ret verdict) {
  switch (verdict) {
    case LZMA_OK:
    case LZMA_STREAM_END:
    case LZMA_BUF_ERROR:
      return nullptr;
    case LZMA_FORMAT_ERROR:
      return "not the xz format";
    case LZMA_MEMLIMIT_ERROR:
      return "asks for a dictionary above 64 MiB";
    case LZMA_OPTIONS_ERROR:
      return "asks for a filter that is not known";
    default:
      return "damaged";
  }
}

class XzDecoder : public StreamDecoder {
 public:
  explicit XzDecoder(const PackedName& name) : name_(name) { restart(); }
  ~XzDecoder() override { lzma_end(&stream_); }
  XzDecoder(const XzDecoder&) = delete;
  XzDecoder& operator=(const XzDecoder&) = delete;

  [[nodiscard]] Step step(std::span<const std::byte> packed, std::span<std::byte> out) override {
    stream_.next_in = reinterpret_cast<const std::uint8_t*>(packed.data());
    stream_.avail_in = packed.size();
    stream_.next_out = reinterpret_cast<std::uint8_t*>(out.data());
    stream_.avail_out = out.size();
    const lzma_ret verdict = lzma_code(&stream_, LZMA_RUN);
    if (verdict == LZMA_MEM_ERROR) fail_no_memory(name_);
    return {.taken = packed.size() - stream_.avail_in,
            .given = out.size() - stream_.avail_out,
            .ended = verdict == LZMA_STREAM_END,
            .wrong = why_wrong(verdict)};
  }
  void restart() override {
    if (lzma_stream_decoder(&stream_, kMaxXzBytes, /*flags=*/0) != LZMA_OK) fail_no_memory(name_);
  }

 private:
  PackedName name_;
  lzma_stream stream_ = LZMA_STREAM_INIT;
};

}  // namespace

std::vector<std::byte> unpack_xz(std::span<const std::byte> packed, std::size_t max,
                                 std::string_view name) {
  const PackedName named{"xz", name};
  XzDecoder decoder(named);
  return unpack_streams(decoder, packed, max, named);
}

namespace {

/// The most bytes that a block of Zstandard holds; it takes 4 packed bytes or more.
constexpr std::size_t kBlockBytes = std::size_t{128} << 10U;

struct FreeContext {
  void operator()(ZSTD_DCtx* context) const { ZSTD_freeDCtx(context); }
};

}  // namespace

// Unpacks at once into place: a stream would take a window as large as the frame claims.
std::vector<std::byte> unpack_zstd(std::span<const std::byte> packed, std::size_t max,
                                   std::string_view name) {
  const PackedName named{"zstd", name};
  // To make a context costs more than to unpack a small chunk.
  thread_local const std::unique_ptr<ZSTD_DCtx, FreeContext> context(ZSTD_createDCtx());
  if (!context) fail_no_memory(named);
  std::vector<std::byte> out(std::min(max, (packed.size() / 4 + 1) * kBlockBytes));
  const std::size_t count =
      ZSTD_decompressDCtx(context.get(), out.data(), out.size(), packed.data(), packed.size());
  if (ZSTD_isError(count) != 0) {
    const ZSTD_ErrorCode code = ZSTD_getErrorCode(count);
    if (code == ZSTD_error_dstSize_tooSmall) fail_too_much(named, max);
    if (code == ZSTD_error_memory_allocation) fail_no_memory(named);
    fail_packed(named, text("damaged or truncated (", ZSTD_getErrorName(count), ")"));
  }
  out.resize(count);
  return out;
}

namespace {

class ZstdDecoder : public StreamDecoder {
 public:
  explicit ZstdDecoder(const PackedName& name) : name_(name), context_(ZSTD_createDCtx()) {
    constexpr int kWindowBits = std::countr_zero(kMaxZstdWindow);
    if (!context_) fail_no_memory(name);
    ZSTD_DCtx_setParameter(context_.get(), ZSTD_d_windowLogMax, kWindowBits);
  }

  [[nodiscard]] Step step(std::span<const std::byte> packed, std::span<std::byte> out) override {
    ZSTD_inBuffer from{packed.data(), packed.size(), 0};
    ZSTD_outBuffer to{out.data(), out.size(), 0};
    const std::size_t verdict = ZSTD_decompressStream(context_.get(), &to, &from);
    const bool failed = ZSTD_isError(verdict) != 0;
    if (failed) refuse_large(ZSTD_getErrorCode(verdict));
    return {.taken = from.pos,
            .given = to.pos,
            .ended = verdict == 0,
            .wrong = failed ? ZSTD_getErrorName(verdict) : nullptr};
  }
  void restart() override {}  // the library does so by itself

 private:
  void refuse_large(ZSTD_ErrorCode code) const {
    if (code == ZSTD_error_memory_allocation) fail_no_memory(name_);
    if (code != ZSTD_error_frameParameter_windowTooLarge) return;
    throw Error(ErrorKind::kResource,
                text(name_.file, ": zstd: looks back more than ", kMaxZstdWindow,
                     " bytes, too far for a chunk of this size; give more --memory, or pack it at "
                     "level 19 or below"));
  }

  PackedName name_;
  std::unique_ptr<ZSTD_DCtx, FreeContext> context_;
};

}  // namespace

std::unique_ptr<StreamDecoder> stream_decoder(Codec codec, const PackedName& name) {
  switch (codec) {
    case Codec::kGzip:
      return std::make_unique<DeflateDecoder>(kGzip, name);
    case Codec::kZlib:
      return std::make_unique<DeflateDecoder>(kZlib, name);
    case Codec::kBzip2:
      return std::make_unique<Bunzipper>(name);
    case Codec::kXz:
      return std::make_unique<XzDecoder>(name);
    case Codec::kZstd:
      return std::make_unique<ZstdDecoder>(name);
    default:
      return nullptr;
  }
}

ZstdPacker::ZstdPacker(int level) : context_(ZSTD_createCCtx()), level_(level) {
  if (context_ == nullptr) throw std::bad_alloc();
}

ZstdPacker::~ZstdPacker() {
  ZSTD_freeCCtx(context_);
}

void ZstdPacker::append(std::span<const std::byte> bytes, std::vector<std::byte>& out) {
  const std::size_t before = out.size();
  out.resize(before + ZSTD_compressBound(bytes.size()));
  const std::size_t size = ZSTD_compressCCtx(context_, out.data() + before, out.size() - before,
                                             bytes.data(), bytes.size(), level_);
  if (ZSTD_isError(size) != 0) throw std::bad_alloc();
  out.resize(before + size);
}

}  // namespace mw::io
