#pragma once

#include "qmcf/pipeline/mesh_surface.hpp"
