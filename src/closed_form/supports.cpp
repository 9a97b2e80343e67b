#include "closed_form/supports.h"

#include <initializer_list>

namespace whirl::closed_form {

ReducedSupports reduced_supports(const Support &left, const Support &right) {
    ReducedSupports reduced;
    for (const Support &support : {left, right}) {
        const double z = support.position;
        reduced.c_x += support.stiffness;
        reduced.c_y += support.stiffness * z;
        reduced.c_beta += support.stiffness * z * z;
        reduced.h_x += support.damping;
        reduced.h_y += support.damping * z;
        reduced.h_beta += support.damping * z * z;
    }
    return reduced;
}

} // namespace whirl::closed_form
