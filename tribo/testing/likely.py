"""What is most often wrong where a check fails."""

_OFTEN = """
work in place, a global seed, or numpy.seterr: calls_leave_no_trace
a cache, a counter, a buffer used again, or fresh noise: same_inputs_give_same_bits
a number of the code, or of another unit: units_may_be_rescaled
a mean, a shift, or swapped axes: reach_is_as_declared
a mean or scale of the window, a cell for a length, swapped axes: another_window_changes_little
a length of the track, a mean, or swapped axes: averages_are_linear
swapped axes, a symmetry, or another zero of the gap: pressure_goes_with_the_gap
a cell for a length or an area: finer_cells_change_little
a field that follows the pressure, or a factor left out in one of the two: slopes_are_derivatives
a factor or a sign in one alone: curvature_is_that_of_the_heights product_is_that_of_differences
shares of time for shares of the path, or another amplitude: speeds_share_the_path
a sign, growth by itself, or no term that ends it: states_can_last
a threshold that is not declared: rates_jump_at_breaks_alone
a name in the code, or the last body: bodies_may_have_any_names bodies_change_places_as_named
what is left out, or a number in its place: what_is_declared_matters
problem.wear, or a part of it, left out: wear_compliance_adds_its_depth
a part of one body alone: cap_acts_where_it_is_reached no_mode_is_stiffer_than_stated
the zero of the approach, or a part of one body alone: more_load_goes_deeper
a distance in place of a state, or wear that should feed it: state_is_all_that_remembers
the contact of the start: warm_start_changes_nothing
a name, a state or an end that a run need not have: any_run_is_survived
"""
_LINES = [line.split(": ") for line in _OFTEN.strip().splitlines()]
LIKELY = {name: words for words, names in _LINES for name in names.split()}
"""The likely mistakes, by the name of the check."""
