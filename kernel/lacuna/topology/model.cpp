// SPDX-License-Identifier: MIT
#include <lacuna/topology/model.h>
