#include "oracles/answers.h"

#include <map>
#include <stdexcept>

namespace whirl::oracles {

void no_answer(const std::string &reason) { throw std::runtime_error(reason); }

Answer answer(const Request &request) {
    static const std::map<std::string, Answer (*)(const Request &)> answers{
        {"campbell", answer_campbell}, {"critical", answer_critical},
        {"response", answer_response}, {"stability", answer_stability},
        {"show", answer_show},         {"balance", answer_balance},
        {"simulate", answer_simulate}, {"rigid-limit", answer_rigid_limit},
        {"samples", answer_samples}};
    if (request.rotor.rings_or_rows())
        return answer_carried(request);
    if (request.rotor.mounted() && !request.rotor.rigid && request.command == "response")
        return answer_operation(request);
    if (request.rotor.mounted())
        return answer_mounted(request);
    if (request.rotor.axial_torque != 0)
        return answer_twisted(request);
    if (!request.rotor.rotary_inertia)
        no_answer("sections without rotary inertia: no oracle");
    const auto found = answers.find(request.command);
    if (found == answers.end())
        no_answer("no oracle for the command " + request.command);
    return found->second(request);
}

} // namespace whirl::oracles
