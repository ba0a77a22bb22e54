//! Displayed time of transient runs. It follows the computation until the user chooses a time, and then changes
//! only while playing.

/// Duration of playing the whole run \[s\].
const WHOLE_S: f64 = 10.0;

/// Displayed time, and the state of playing.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Player {
    /// T.
    time: f64,
    /// Last computed T.
    end: f64,
    playing: bool,
    taken: bool,
}

impl Player {
    /// Returns T, limited to the computed range.
    pub fn time(&self) -> f64 {
        self.time.min(self.end)
    }

    /// Returns the last computed T.
    pub fn end(&self) -> f64 {
        self.end
    }

    pub fn playing(&self) -> bool {
        self.playing
    }

    /// Sets the last computed T.
    pub fn reached(&mut self, time: f64) {
        self.end = time;
        if !self.taken {
            self.time = time;
        }
    }

    /// Moves to a time and stops playing.
    pub fn go_to(&mut self, time: f64) {
        (self.taken, self.playing) = (true, false);
        self.time = time.clamp(0.0, self.end);
    }

    /// Starts playing from the present time, or from the beginning if it is at the end. Pauses if it is playing.
    pub fn toggle(&mut self) {
        self.taken = true;
        self.playing = !self.playing;
        if self.playing && self.time >= self.end {
            self.time = 0.0;
        }
    }

    /// Advances by seconds of the clock in a run of length `duration`.
    pub fn advance(&mut self, seconds: f64, duration: f64) {
        if self.playing {
            self.time = (self.time + seconds * duration / WHOLE_S).min(self.end);
            self.playing = self.time < self.end;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_follows_until_it_is_taken_and_plays_to_the_end() {
        let mut player = Player::default();
        player.reached(3.0);
        assert_eq!(player.time(), 3.0);
        player.go_to(7.0);
        player.reached(4.0);
        assert_eq!((player.time(), player.end()), (3.0, 4.0));
        player.advance(1.0, 8.0);
        assert_eq!(player.time(), 3.0, "nothing moves before the user plays");
        player.reached(1.0);
        assert_eq!(player.time(), 1.0, "a new run has come no farther");
        player.reached(4.0);
        assert_eq!(player.time(), 3.0, "and goes to the time that the user chose");
        player.toggle();
        player.advance(1.0, 8.0);
        assert!((player.time() - 3.8).abs() < 1e-12 && player.playing());
        player.advance(1.0, 8.0);
        assert_eq!((player.time(), player.playing()), (4.0, false));
        player.toggle();
        assert_eq!((player.time(), player.playing()), (0.0, true));
    }
}
