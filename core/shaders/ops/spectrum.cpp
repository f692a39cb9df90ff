// The colors of a temperature and of a wavelength, as Blender's nodes have them. [Cycles 4.5 kernel/tables.h,
// kernel/svm/math_util.h, wavelength.h]
#include "core/shaders/ops/tables.h"

namespace pivot {
namespace {

const Batch zero(0.0f);

// Linear Rec. 709 of a black body of luminance 1, fitted piecewise from 800 to 12000 K. Where each piece but the first
// begins, in K; then its coefficients: a / T + b T + c of red and green, and a cubic polynomial of blue, the highest
// power first.
constexpr std::array begins_k{965.0f, 1167.0f, 1449.0f, 1902.0f, 3315.0f, 6365.0f};
constexpr std::array red{1.61919106e03f,   -2.05010916e-03f, 5.02995757e00f,   2.48845471e03f,  -1.11330907e-03f,
                         3.22621544e00f,   3.34143193e03f,   -4.86551192e-04f, 1.76486769e00f,  4.09461742e03f,
                         -1.27446582e-04f, 7.25731635e-01f,  4.67028036e03f,   2.91258199e-05f, 1.26703442e-01f,
                         4.59509185e03f,   2.87495649e-05f,  1.50345020e-01f,  3.78717450e03f,  9.35907826e-06f,
                         3.99075871e-01f};
constexpr std::array green{-4.88999748e02f, 6.04330754e-04f,  -7.55807526e-02f, -7.55994277e02f,  3.16730098e-04f,
                           4.78306139e-01f, -1.02363977e03f,  1.20223470e-04f,  9.36662319e-01f,  -1.26571316e03f,
                           4.87340896e-06f, 1.27054498e00f,   -1.42529332e03f,  -4.01150431e-05f, 1.43972784e00f,
                           -1.17554822e03f, -2.16378048e-05f, 1.30408023e00f,   -5.00799571e02f,  -4.59832026e-06f,
                           1.09098763e00f};
constexpr std::array blue{5.96945309e-11f,  -4.85742887e-08f, -9.70622247e-05f, -4.07936148e-03f, 2.40430366e-11f,
                          5.55021075e-08f,  -1.98503712e-04f, 2.89312858e-02f,  -1.40949732e-11f, 1.89878968e-07f,
                          -3.56632824e-04f, 9.10767778e-02f,  -3.61460868e-11f, 2.84822009e-07f,  -4.93211319e-04f,
                          1.56723440e-01f,  -1.97075738e-11f, 1.75359352e-07f,  -2.50542825e-04f, -2.22783266e-02f,
                          -1.61997957e-13f, -1.64216008e-08f, 3.86216271e-04f,  -7.38077418e-01f, 6.72650283e-13f,
                          -2.73078809e-08f, 4.24098264e-04f,  -7.52335691e-01f};
const Vec3b coldest(Batch(5.413294490189271f), Batch(-0.20319390035873933f), Batch(-0.0822535242887164f));  // < 800 K
const Vec3b hottest(Batch(0.8262954810464208f), Batch(0.9945080501520986f), Batch(1.566307710274283f));  // from 12000 K

/// What lies outside of the gamut is clamped to it.
Vec3b blackbody(Batch temperature_k) {
    Batch piece = zero;
    for (const float begin_k : begins_k) piece += select(temperature_k >= Batch(begin_k), Batch(1.0f), zero);
    const auto coefficient = [&](const auto& table, float count, float i) {
        return fetch(table.data(), to_index(piece * Batch(count) + Batch(i)));
    };
    const auto hyperbola = [&](const auto& table) {
        return coefficient(table, 3, 0) / temperature_k + coefficient(table, 3, 1) * temperature_k +
               coefficient(table, 3, 2);
    };
    Batch cubic = coefficient(blue, 4, 0);
    for (const float i : {1.0f, 2.0f, 3.0f}) cubic = cubic * temperature_k + coefficient(blue, 4, i);
    const Vec3b fitted(hyperbola(red), hyperbola(green), cubic);
    const Vec3b color = select(temperature_k < Batch(800.0f), coldest, fitted);
    return max(select(temperature_k >= Batch(12000.0f), hottest, color), Vec3b(zero));
}

// The CIE's color matching functions of 1931, from 380 to 780 nm in steps of 5.
constexpr std::array cie_x{
    0.0014f, 0.0022f, 0.0042f, 0.0076f, 0.0143f, 0.0232f, 0.0435f, 0.0776f, 0.1344f, 0.2148f, 0.2839f, 0.3285f,
    0.3483f, 0.3481f, 0.3362f, 0.3187f, 0.2908f, 0.2511f, 0.1954f, 0.1421f, 0.0956f, 0.0580f, 0.0320f, 0.0147f,
    0.0049f, 0.0024f, 0.0093f, 0.0291f, 0.0633f, 0.1096f, 0.1655f, 0.2257f, 0.2904f, 0.3597f, 0.4334f, 0.5121f,
    0.5945f, 0.6784f, 0.7621f, 0.8425f, 0.9163f, 0.9786f, 1.0263f, 1.0567f, 1.0622f, 1.0456f, 1.0026f, 0.9384f,
    0.8544f, 0.7514f, 0.6424f, 0.5419f, 0.4479f, 0.3608f, 0.2835f, 0.2187f, 0.1649f, 0.1212f, 0.0874f, 0.0636f,
    0.0468f, 0.0329f, 0.0227f, 0.0158f, 0.0114f, 0.0081f, 0.0058f, 0.0041f, 0.0029f, 0.0020f, 0.0014f, 0.0010f,
    0.0007f, 0.0005f, 0.0003f, 0.0002f, 0.0002f, 0.0001f, 0.0001f, 0.0001f, 0.0000f};
constexpr std::array cie_y{
    0.0000f, 0.0001f, 0.0001f, 0.0002f, 0.0004f, 0.0006f, 0.0012f, 0.0022f, 0.0040f, 0.0073f, 0.0116f, 0.0168f,
    0.0230f, 0.0298f, 0.0380f, 0.0480f, 0.0600f, 0.0739f, 0.0910f, 0.1126f, 0.1390f, 0.1693f, 0.2080f, 0.2586f,
    0.3230f, 0.4073f, 0.5030f, 0.6082f, 0.7100f, 0.7932f, 0.8620f, 0.9149f, 0.9540f, 0.9803f, 0.9950f, 1.0000f,
    0.9950f, 0.9786f, 0.9520f, 0.9154f, 0.8700f, 0.8163f, 0.7570f, 0.6949f, 0.6310f, 0.5668f, 0.5030f, 0.4412f,
    0.3810f, 0.3210f, 0.2650f, 0.2170f, 0.1750f, 0.1382f, 0.1070f, 0.0816f, 0.0610f, 0.0446f, 0.0320f, 0.0232f,
    0.0170f, 0.0119f, 0.0082f, 0.0057f, 0.0041f, 0.0029f, 0.0021f, 0.0015f, 0.0010f, 0.0007f, 0.0005f, 0.0004f,
    0.0002f, 0.0002f, 0.0001f, 0.0001f, 0.0001f, 0.0000f, 0.0000f, 0.0000f, 0.0000f};
constexpr std::array cie_z{
    0.0065f, 0.0105f, 0.0201f, 0.0362f, 0.0679f, 0.1102f, 0.2074f, 0.3713f, 0.6456f, 1.0391f, 1.3856f, 1.6230f,
    1.7471f, 1.7826f, 1.7721f, 1.7441f, 1.6692f, 1.5281f, 1.2876f, 1.0419f, 0.8130f, 0.6162f, 0.4652f, 0.3533f,
    0.2720f, 0.2123f, 0.1582f, 0.1117f, 0.0782f, 0.0573f, 0.0422f, 0.0298f, 0.0203f, 0.0134f, 0.0087f, 0.0057f,
    0.0039f, 0.0027f, 0.0021f, 0.0018f, 0.0017f, 0.0014f, 0.0011f, 0.0010f, 0.0008f, 0.0006f, 0.0003f, 0.0002f,
    0.0002f, 0.0001f, 0.0000f, 0.0000f, 0.0000f, 0.0000f, 0.0000f, 0.0000f, 0.0000f, 0.0000f, 0.0000f, 0.0000f,
    0.0000f, 0.0000f, 0.0000f, 0.0000f, 0.0000f, 0.0000f, 0.0000f, 0.0000f, 0.0000f, 0.0000f, 0.0000f, 0.0000f,
    0.0000f, 0.0000f, 0.0000f, 0.0000f, 0.0000f, 0.0000f, 0.0000f, 0.0000f, 0.0000f};
/// Black beyond.
Vec3b wavelength_xyz(Batch wavelength_nm) {
    const Batch place = (wavelength_nm - Batch(380.0f)) * Batch(0.2f);
    const BatchMask visible = place > Batch(-1.0f) && place < Batch(80.0f);
    const Batch first = select(visible, trunc(place), zero), part = place - first;
    const auto matched = [&](const auto& table) {
        const Batch a = fetch(table.data(), to_index(first)), b = fetch(table.data() + 1, to_index(first));
        return a + part * (b - a);
    };
    return select(visible, Vec3b(matched(cie_x), matched(cie_y), matched(cie_z)), Vec3b(zero));
}

constexpr std::array ops{
    op<blackbody>("blackbody"),
    op<wavelength_xyz>("wavelength_xyz"),
};

}  // namespace

std::span<const OpKind> spectrum_ops() { return ops; }

}  // namespace pivot
