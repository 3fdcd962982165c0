#ifndef rhombicGLBContainer_h
#define rhombicGLBContainer_h

#include <array>
#include <cstdint>

/** Constants of binary glTF (Khronos, "glTF 2.0 Specification", sections 4.4, 5.1 and 5.22). */
namespace rhombic::glb
{

constexpr std::uint32_t Magic = 0x46546c67;     // "glTF"
constexpr std::uint32_t JsonChunk = 0x4e4f534a; // "JSON"
constexpr std::uint32_t BinChunk = 0x004e4942;  // "BIN"
constexpr std::uint32_t HeaderSize = 12;
constexpr std::uint32_t ChunkHeaderSize = 8;

constexpr int UnsignedByte = 5121;
constexpr int UnsignedShort = 5123;
constexpr int UnsignedInt = 5125;
constexpr int Float = 5126;

constexpr int ArrayBuffer = 34962;
constexpr int ElementArrayBuffer = 34963;

constexpr int Triangles = 4;
constexpr int TriangleStrip = 5;
constexpr int TriangleFan = 6;

/** Matrices, column by column, from LPS or RAS millimetres to glTF's metres with y up and z to the front: the patient
 * stands and faces the viewer. */
constexpr std::array<double, 16> FromLPS{ 0.001, 0, 0, 0, 0, 0, -0.001, 0, 0, 0.001, 0, 0, 0, 0, 0, 1 };
constexpr std::array<double, 16> FromRAS{ -0.001, 0, 0, 0, 0, 0, 0.001, 0, 0, 0.001, 0, 0, 0, 0, 0, 1 };

} // namespace rhombic::glb

#endif
