"""The parameters of one's own system are parameters of its explorer, and no name is set that nothing reads."""

import panel as pn
import pytest
from codim2_app import explorer

import codim2_core as c2

SYSTEM = c2.System(U=("-k*c + push", "-k*s"), parameters={"k": 1.0, "push": 0.5})


def test_a_parameter_is_set_watched_linked_and_kept():
    view, seen = explorer(SYSTEM), []
    view.param.watch(lambda event: seen.append(event.new), "k")
    view.k = 3.0
    assert view.scene.system.parameters["k"] == view.state.parameters["k"] == 3.0
    view.state.parameters = {"k": 2.0, "push": 0.1}
    assert (view.k, view.push, seen) == (2.0, 0.1, [3.0, 2.0])
    slider = pn.widgets.FloatSlider(start=0.0, end=5.0)
    slider.link(view, value="k")
    slider.value = 4.0
    assert view.scene.system.parameters == {"k": 4.0, "push": 0.1}
    assert view.clone().k == 4.0
    assert explorer(SYSTEM).k == 1.0  # another view of the system keeps its own


def test_a_name_that_nothing_reads_is_refused_and_the_near_ones_named():
    view = explorer(SYSTEM)
    with pytest.raises(AttributeError, match=r"no parameter of this explorer\. The nearest names are push"):
        view.pusch = 1.0
    view.trajectories = 12
    assert view.state.trajectories == 12
