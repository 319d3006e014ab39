//! What the device is: its parameters from measured rows of inputs and outputs.
