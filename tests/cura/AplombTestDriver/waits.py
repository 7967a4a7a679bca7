"""What the story waits for: functions that say whether it may go on."""
import time


def after(seconds):
    until = time.monotonic() + seconds
    return lambda: time.monotonic() > until


def at_rest(models, seconds=2, turns=20):
    """Cura sets models down on the plate: until it has had time to, and in so many turns of the timer none has moved."""
    is_time = after(seconds)
    places = []

    def is_done():
        places.append([node.getWorldTransformation().getData().tobytes() for node in models()])
        return is_time() and len(places) >= turns and all(one == places[-1] for one in places[-turns:])
    return is_done
