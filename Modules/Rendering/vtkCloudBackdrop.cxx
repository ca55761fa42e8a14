// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCloudBackdrop.h"

vtkCloudBackdrop::vtkCloudBackdrop() = default;
vtkCloudBackdrop::~vtkCloudBackdrop() = default;
