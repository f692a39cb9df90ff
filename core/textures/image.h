// A picture that shaders look up, kept as it was stored: bytes stay bytes, and what turns them into linear light is
// done to what a lookup interpolates. What a footprint covers is looked up in smaller copies, made when first needed.
//
// Texels are where Cycles has them: u and v run over 0..1, the first row is the bottom one, and a texel's value is at
// its middle. Where the footprint is within a texel a lookup is Cycles'. [Cycles 4.5 kernel/device/cpu/image.h,
// svm/image.h]
#pragma once

#include <memory>
#include <mutex>
#include <span>
#include <tuple>
#include <vector>

#include "core/simd/batch.h"

namespace pivot {

/// How the numbers of a texel are stored: whole numbers stand for 0..1.
enum class TexelType : std::uint32_t { uint8, uint16, float16, float32 };

enum class Interpolation : std::uint32_t { closest, linear, cubic };

/// What is beside the picture: itself again, its edge, nothing, or its mirror image.
enum class Extension : std::uint32_t { repeat, extend, clip, mirror };

struct ImageLookup {
    Interpolation interpolation = Interpolation::linear;
    Extension extension = Extension::repeat;
    /// The colours are kept multiplied by alpha, and asked for without.
    bool unassociate = false;
    /// u = 0 and u = 1 are one place, so that neighbours across them are near.
    bool closed_u = false;
};

/// Immutable.
struct Image {
    /// texels: height rows of width texels of 1 to 4 channels (grey; grey, alpha; RGB; RGBA). Throws
    /// std::invalid_argument for a size that is none or does not fit them.
    Image(std::uint32_t width, std::uint32_t height, std::uint32_t channels, TexelType type, bool is_srgb,
          std::span<const std::byte> texels);

    std::uint32_t width() const { return levels_[0].width; }
    std::uint32_t height() const { return levels_[0].height; }
    /// With the smaller copies.
    std::size_t memory_bytes() const { return memory_bytes_; }

    /// Linear colour and alpha at a place whose neighbours, the width of a footprint away, are at uv_x and uv_y.
    std::tuple<Vec3b, Batch> lookup(const ImageLookup& how, const Vec2b& uv, const Vec2b& uv_x,
                                    const Vec2b& uv_y) const;

    /// Makes the smaller copies, if nobody has. A lookup that needs them does so too, but then others wait for it.
    void make_levels() const;

    /// The picture, and copies of it each of half the size of the one before, down to one texel.
    struct Level {
        std::uint32_t width, height;
        std::size_t first_byte;
    };
    std::span<const Level> levels() const { return levels_; }
    /// A level's texels in linear light: height x width x RGBA.
    std::vector<float> linear_rgba(std::size_t level) const;

   private:
    struct Row;
    std::size_t texel_bytes() const;
    Row linear_row(const Level& level, std::uint32_t y) const;
    void store_row(const Level& level, std::uint32_t y, Row row) const;
    void make_level(const Level& from, const Level& to) const;

    TexelType type_;
    std::uint32_t channels_;
    bool is_srgb_;
    std::vector<Level> levels_;
    std::size_t memory_bytes_;
    /// All levels', and a few more bytes, for reads of whole words. Those of the copies take no memory until they are
    /// made: while other images are read, which takes several times what is kept, and where nothing looks them up.
    std::unique_ptr<std::byte[]> texels_;
    mutable std::once_flag are_levels_made_;
};

}  // namespace pivot
