#pragma once

// Owners of SLEPc and PETSc objects; only for sources in linalg.

#include <slepceps.h>
#include <slepcpep.h>

#include <memory>

namespace whirl::linalg {

/// Destroys by the library's own function; what it returns cannot be acted on in a destructor.
template <class Object, PetscErrorCode (*destroy)(Object *)> struct Destroy {
    void operator()(Object object) const noexcept { destroy(&object); }
};

template <class Object, PetscErrorCode (*destroy)(Object *)>
using Owner = std::unique_ptr<std::remove_pointer_t<Object>, Destroy<Object, destroy>>;

using VecOwner = Owner<Vec, VecDestroy>;
using MatOwner = Owner<Mat, MatDestroy>;
using EpsOwner = Owner<EPS, EPSDestroy>;
using PepOwner = Owner<PEP, PEPDestroy>;

} // namespace whirl::linalg
