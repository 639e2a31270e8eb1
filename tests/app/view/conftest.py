import pytest
from codim2_app.picture.state.controls import ExplorerState
from codim2_app.view.refresh import Frames


@pytest.fixture
def frames():
    """What one visitor's page is sent, after its first frame."""
    made = Frames(ExplorerState())
    made.answer({"all": True})
    return made
