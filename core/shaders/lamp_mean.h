// How bright a lamp's own nodes leave it, on the whole.
#pragma once

#include "core/lights/light.h"
#include "core/shaders/shader.h"

namespace pivot {

/// The mean of what a lamp's shader leaves of its light, in grey, over the sides that it shines to, some of its sizes
/// or 1 m away.
float mean_lamp_share(const Shader& shader, const Light& light);

}  // namespace pivot
