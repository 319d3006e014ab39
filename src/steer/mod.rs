//! Where the external magnet must be: inputs that bring the tip to a target.
